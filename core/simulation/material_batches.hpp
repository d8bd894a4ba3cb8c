#pragma once

#include "checkpoint/archive.hpp"
#include "model/model.hpp"
#include "plugin/registry.hpp"
#include "scene/scene.hpp"

#include <talus/material.hpp>

#include <array>
#include <vector>

namespace talus {

/// Deformation and stress of a few elements, small enough to stay in the cache.
struct ElementBuffer {
  static constexpr std::uint32_t most = 256;  ///< elements

  double deformation[4][most], stress[4][most];  ///< xx, xy, yx, yy; F, and P in Pa
  double energy[most], dissipated[most];         ///< J/m³
  std::vector<double> state;                     ///< of t_n, [element * doubles_per_element]
};

/// The materials of the elements that deform, and what is kept of each element from step to step: the states
/// of its material, the deformation where its material asks for it, and stress for output where it does not
/// follow from how a block is deformed.
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

  /// Cauchy stress xx, yy, xy, Pa, when the element was last kept, of a body of many elements.
  const std::array<double, 3>& cauchy(std::size_t element) const { return cauchy_[element]; }
  /// The same of an affine block of a displacement gradient.
  std::array<double, 3> cauchy(std::uint32_t element, const Matrix2& gradient) const;

  void exchange(Archive& archive);

  std::vector<double> memory() const;
  void set_memory(const std::vector<double>& memory);

 private:
  struct Batch {
    Made<Material> material;
    std::uint32_t begin, end;  ///< elements
    bool needs_previous;
    const Material* sweeping;
    std::vector<double> state;
    std::vector<double> deformation[4];  ///< of t_n, if needs_previous
  };

  std::vector<Batch> batches_;
  /// [element] as cauchy() says it; empty where there are only blocks of materials without memory.
  std::vector<std::array<double, 3>> cauchy_;
};

}  // namespace talus
