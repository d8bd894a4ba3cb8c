#include "simulation/material_batches.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace talus {
namespace {

/// The time step is voted by them.
void refuse_unsound(const Material& material, const RegisteredComponent& component) {
  std::array<double, 9> tangent{};
  material.stiffest_tangent(tangent.data());
  const auto refuse = [&](const char* what, double found, const char* wanted) {
    throw PluginError(fmt::format("{}: material '{}' gave {} as {}; wanted {}; mend the material",
                                  component.file.string(), component.component->name, found, what, wanted));
  };
  for (std::size_t i = 0; i < tangent.size(); ++i) {
    const bool on_diagonal = i % 4 == 0;
    if (std::isfinite(tangent[i]) && (!on_diagonal || tangent[i] > 0)) continue;
    refuse("an entry of its stiffest tangent", tangent[i], "finite numbers, above 0 on the diagonal");
  }
  const double viscous_time = material.viscous_time();
  if (!(std::isfinite(viscous_time) && viscous_time >= 0))
    refuse("its viscous time", viscous_time, "a finite number from 0 on");
  if (material.doubles_per_element() > most_state_doubles)
    refuse("the doubles it keeps per element", material.doubles_per_element(), "4096 at most");
}

/// What a material must write, in audit builds.
void poison([[maybe_unused]] ElementBuffer& buffer, [[maybe_unused]] std::uint32_t count) {
#ifdef TALUS_AUDIT
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (auto& component : buffer.stress) std::fill(component, component + count, nan);
  for (auto& component : buffer.viscous_stress) std::fill(component, component + count, nan);
  for (double* one : {buffer.energy, buffer.dissipated}) std::fill(one, one + count, nan);
#endif
}

/// All of it but `state`.
MaterialResponse response_in(ElementBuffer& buffer) {
  MaterialResponse output{};
  for (int k = 0; k < 4; ++k) {
    output.stress[k] = buffer.stress[k];
    output.viscous_stress[k] = buffer.viscous_stress[k];
  }
  output.energy = buffer.energy;
  output.dissipated = buffer.dissipated;
  return output;
}

std::array<double*, 4> from(std::vector<double> (&components)[4], std::size_t first) {
  return {components[0].data() + first, components[1].data() + first, components[2].data() + first,
          components[3].data() + first};
}

/// σ = P Fᵀ / det F.
std::array<double, 3> cauchy_of(const ElementBuffer& buffer, std::uint32_t i) {
  const auto& [xx, xy, yx, yy] = buffer.deformation;
  const double fxx = xx[i], fxy = xy[i], fyx = yx[i], fyy = yy[i];
  const double pxx = buffer.stress[0][i], pxy = buffer.stress[1][i], pyx = buffer.stress[2][i],
               pyy = buffer.stress[3][i];
  const double volume = fxx * fyy - fxy * fyx;
  const double shear = (pxx * fyx + pxy * fyy + pyx * fxx + pyy * fxy) / 2;
  return {(pxx * fxx + pxy * fxy) / volume, (pyx * fyx + pyy * fyy) / volume, shear / volume};
}

}  // namespace

bool ElementBuffer::any_inside_out(std::uint32_t count) const {
  const auto& [xx, xy, yx, yy] = deformation;
  bool any = false;
  for (std::uint32_t i = 0; i < count; ++i) any |= !(xx[i] * yy[i] - xy[i] * yx[i] > 0);
  return any;
}

MaterialBatches::MaterialBatches(const Scene& scene, const Model& model)
    : kernels_(kernels::element_kernels(scene.simd)) {
  bool remembers = false;
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const std::uint32_t begin = model.material_element_start[m], end = model.material_element_start[m + 1];
    if (begin == end) continue;
    const Choice& choice = scene.materials[m].model;
    auto material = make<Material>(*choice.component, choice.values);
    refuse_unsound(*material, *choice.component);
    const std::size_t states = std::size_t{end - begin} * material->doubles_per_element();
    const bool viscous = material->viscous_time() > 0;
    const bool needs_previous = viscous || material->needs_previous_deformation();
    const bool sweeps = material->sweeps() && states == 0 && !needs_previous;
    remembers = remembers || states > 0 || needs_previous;
    const Material* const sweeping = sweeps ? material.get() : nullptr;
    Batch& batch = batches_.emplace_back(Batch{std::move(material),
                                               begin,
                                               end,
                                               needs_previous,
                                               viscous,
                                               sweeping,
                                               std::vector<double>(states),
                                               {},
                                               {}});
    for (int k = 0; k < 4 && needs_previous; ++k)
      batch.deformation[k].assign(end - begin, k == 0 || k == 3 ? 1.0 : 0.0);
    for (int k = 0; k < 4 && viscous; ++k) batch.viscous_stress[k].resize(end - begin);
  }
  if (remembers) cauchy_.resize(model.element_body.size());
}

std::uint32_t MaterialBatches::batch_of(std::uint32_t element) const {
  std::uint32_t batch = 0;
  while (element >= batches_[batch].end) ++batch;
  return batch;
}

void MaterialBatches::evaluate(std::uint32_t index, std::uint32_t element, std::uint32_t count, double dt,
                               bool keep, ElementBuffer& buffer) {
  Batch& batch = batches_[index];
  const std::size_t doubles = batch.material->doubles_per_element(), first = element - batch.begin;
  double* state = batch.state.data() + doubles * first;
  if (buffer.state.size() < doubles * ElementBuffer::most) buffer.state.resize(doubles * ElementBuffer::most);
  poison(buffer, count);
  MaterialBatch input{};
  for (int k = 0; k < 4; ++k) {
    input.deformation[k] = buffer.deformation[k];
    input.previous_deformation[k] =
        batch.needs_previous ? batch.deformation[k].data() + first : buffer.deformation[k];
  }
  input.state = state;
  input.dt = dt;
  input.count = count;
  MaterialResponse output = response_in(buffer);
  output.state = buffer.state.data();
  batch.material->evaluate(input, output);
  if (batch.viscous) {
    // ½ (P_v,{n-1} + P_v,n) : (F_n − F_{n-1}), as central differences have it (Eqs. 22–24): the stress of t_n
    // acts on half of the step behind and half of the one ahead, in which a fast mode may turn over.
    kernels_.work_of_step(count, output.viscous_stress, input.deformation,
                          from(batch.viscous_stress, first).data(), from(batch.deformation, first).data(),
                          buffer.dissipated);
  }
  std::copy(buffer.state.data(), buffer.state.data() + doubles * count, state);
  for (int k = 0; k < 4 && batch.needs_previous && !batch.viscous; ++k)
    std::copy(buffer.deformation[k], buffer.deformation[k] + count, batch.deformation[k].data() + first);
  for (std::uint32_t i = 0; i < count && keep && keeps_stress(); ++i)
    cauchy_[element + i] = cauchy_of(buffer, i);
}

void MaterialBatches::cauchy(std::uint32_t element, std::span<const Matrix2> gradients,
                             std::array<double, 3>* stress) const {
  if (keeps_stress()) {
    std::copy_n(cauchy_.data() + element, gradients.size(), stress);
    return;
  }
  ElementBuffer buffer;
  poison(buffer, static_cast<std::uint32_t>(gradients.size()));
  for (std::size_t i = 0; i < gradients.size(); ++i) {
    const Matrix2& h = gradients[i];
    buffer.deformation[0][i] = 1 + h.xx, buffer.deformation[1][i] = h.xy;
    buffer.deformation[2][i] = h.yx, buffer.deformation[3][i] = 1 + h.yy;
  }
  MaterialBatch input{};
  for (int k = 0; k < 4; ++k) input.deformation[k] = input.previous_deformation[k] = buffer.deformation[k];
  input.dt = 1;  // what it does to a material without memory
  input.count = static_cast<std::uint32_t>(gradients.size());
  batches_[batch_of(element)].material->evaluate(input, response_in(buffer));
  for (std::uint32_t i = 0; i < gradients.size(); ++i) stress[i] = cauchy_of(buffer, i);
}

void MaterialBatches::exchange(Archive& archive) {
  for (Batch& batch : batches_) {
    archive.of_known_size(batch.state);
    for (std::vector<double>& component : batch.deformation) archive.of_known_size(component);
    for (std::vector<double>& component : batch.viscous_stress) archive.of_known_size(component);
  }
  archive.of_known_size(cauchy_);
}

std::vector<double> MaterialBatches::memory() const {
  std::vector<double> all;
  for (const Batch& batch : batches_) {
    for (const std::vector<double>& component : batch.deformation)
      all.insert(all.end(), component.begin(), component.end());
    all.insert(all.end(), batch.state.begin(), batch.state.end());
  }
  return all;
}

void MaterialBatches::set_memory(const std::vector<double>& memory) {
  const double* from = memory.data();
  const auto take = [&](double* to, std::size_t count) {
    std::copy(from, from + count, to);
    from += count;
  };
  for (Batch& batch : batches_) {
    for (std::vector<double>& component : batch.deformation) take(component.data(), component.size());
    take(batch.state.data(), batch.state.size());
  }
}

}  // namespace talus
