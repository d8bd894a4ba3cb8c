#pragma once

#include "archive/archive.hpp"
#include "kernels/level.hpp"
#include "model/model.hpp"
#include "plugin/registry.hpp"
#include "scene/scene.hpp"

#include <talus/material.hpp>

#include <array>
#include <span>
#include <vector>

namespace talus {

/// Deformation and stress of a few elements, small enough to stay in the cache.
struct ElementBuffer {
  static constexpr std::uint32_t most = 256;  ///< elements

  double deformation[4][most], stress[4][most];  ///< xx, xy, yx, yy; F, and P in Pa
  double viscous_stress[4][most];                ///< Pa, of P
  double energy[most], dissipated[most];         ///< J/m³, the latter with the work of viscous stress
  std::vector<double> state;                     ///< of t_n, [element * doubles_per_element]

  /// Whether det F is not above 0, or no number, in any of the first `count` elements.
  bool any_inside_out(std::uint32_t count) const;
};

/// The materials of the elements that deform, and what is kept of each element from step to step: the states
/// of its material, the deformation where its material asks for it, viscous stress where there is any, and
/// stress for output where it does not follow from how an element is deformed.
class MaterialBatches {
 public:
  MaterialBatches(const Scene& scene, const Model& model);

  bool empty() const { return batches_.empty(); }
  /// Of an element, to be handed to evaluate().
  std::uint32_t batch_of(std::uint32_t element) const;
  std::size_t count() const { return batches_.size(); }
  std::uint32_t begin(std::uint32_t batch) const { return batches_[batch].begin; }
  std::uint32_t end(std::uint32_t batch) const { return batches_[batch].end; }

  /// The material of a batch if it takes elements from displacements to forces itself, or null.
  const Material* sweeping(std::uint32_t batch) const { return batches_[batch].sweeping; }

  /// Stress and energies of `count` elements of a batch from the deformation in the buffer. `keep`: for
  /// output. Different elements may be evaluated at once, each with a buffer of its own.
  void evaluate(std::uint32_t batch, std::uint32_t element, std::uint32_t count, double dt, bool keep,
                ElementBuffer& buffer);

  /// Whether evaluate() has to be called for stress to be known: of materials without memory it follows from
  /// displacement gradients.
  bool keeps_stress() const { return !cauchy_.empty(); }
  /// Cauchy stress xx, yy, xy, Pa, of elements side by side in a batch, as many as ElementBuffer::most, from
  /// their displacement gradients, or as it was when they were last kept.
  void cauchy(std::uint32_t element, std::span<const Matrix2> gradients, std::array<double, 3>* stress) const;

  void exchange(Archive& archive);

  std::vector<double> memory() const;
  void set_memory(const std::vector<double>& memory);

 private:
  struct Batch {
    Made<Material> material;
    std::uint32_t begin, end;  ///< elements
    bool needs_previous, viscous;
    const Material* sweeping;
    std::vector<double> state;
    std::vector<double> deformation[4];     ///< of t_n, if needs_previous
    std::vector<double> viscous_stress[4];  ///< Pa, of t_n, if viscous
  };

  const kernels::ElementKernels& kernels_;
  std::vector<Batch> batches_;
  /// [element] as cauchy() says it; empty where no material has a memory.
  std::vector<std::array<double, 3>> cauchy_;
};

}  // namespace talus
