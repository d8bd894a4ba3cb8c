#include "simulation/deformation.hpp"

#include <algorithm>
#include <limits>

namespace talus {

Deformation::Deformation(const Scene& scene, const Model& model) {
  const std::size_t count = model.elements.size();
  for (int k = 0; k < 4; ++k) {
    const double identity = k == 0 || k == 3 ? 1 : 0;
    deformation_[k].assign(count, identity);
    previous_[k].assign(count, identity);
    stress_[k].assign(count, 0.0);
  }
  energy_.assign(count, 0.0);
  dissipated_.assign(count, 0.0);
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const std::uint32_t begin = model.material_element_start[m], end = model.material_element_start[m + 1];
    if (begin == end) continue;
    const Choice& choice = scene.materials[m].model;
    auto material = make<Material>(*choice.component, choice.values);
    const std::size_t states = std::size_t{end - begin} * material->doubles_per_element();
    batches_.push_back(
        {std::move(material), begin, end, std::vector<double>(states), std::vector<double>(states)});
  }
}

Deformation::Energy Deformation::apply(const Model& model, MotionState& motion, double dt) {
  if (batches_.empty()) return {};
  for (int k = 0; k < 4; ++k) deformation_[k].swap(previous_[k]);
  for (std::size_t e = 0; e < model.elements.size(); ++e) {
    const Element& element = model.elements[e];
    const Matrix2 h = element.patch[0] == no_patch ? motion.bodies[element.body].h
                                                   : gradient(element, motion.patch_displacement);
    deformation_[0][e] = 1 + h.xx;
    deformation_[1][e] = h.xy;
    deformation_[2][e] = h.yx;
    deformation_[3][e] = 1 + h.yy;
  }
#ifdef TALUS_AUDIT
  for (auto& component : stress_)
    component.assign(component.size(), std::numeric_limits<double>::quiet_NaN());
#endif
  for (Batch& batch : batches_) {
    MaterialBatch input{};
    MaterialResponse output{};
    for (int k = 0; k < 4; ++k) {
      input.deformation[k] = deformation_[k].data() + batch.begin;
      input.previous_deformation[k] = previous_[k].data() + batch.begin;
      output.stress[k] = stress_[k].data() + batch.begin;
    }
    input.state = batch.state.data();
    input.dt = dt;
    input.count = batch.end - batch.begin;
    output.energy = energy_.data() + batch.begin;
    output.dissipated = dissipated_.data() + batch.begin;
    output.state = batch.next_state.data();
    batch.material->evaluate(input, output);
    batch.state.swap(batch.next_state);
  }
  Energy total;
  for (std::size_t e = 0; e < model.elements.size(); ++e) {
    const Element& element = model.elements[e];
    const double area = element.area;
    total.stored += area * energy_[e];
    total.dissipated += area * dissipated_[e];
    if (element.patch[0] == no_patch) {
      Matrix2& moment = motion.forces[element.body].moment;
      moment.xx -= area * stress_[0][e];
      moment.xy -= area * stress_[1][e];
      moment.yx -= area * stress_[2][e];
      moment.yy -= area * stress_[3][e];
      continue;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2 g = element.gradient[i];
      Vec2& force = motion.patch_force[element.patch[i]];
      force.x -= area * (stress_[0][e] * g.x + stress_[1][e] * g.y);
      force.y -= area * (stress_[2][e] * g.x + stress_[3][e] * g.y);
    }
  }
  return total;
}

/// σ = P Fᵀ / det F.
std::array<double, 3> Deformation::cauchy_of_element(std::size_t e) const {
  const double fxx = deformation_[0][e], fxy = deformation_[1][e], fyx = deformation_[2][e],
               fyy = deformation_[3][e];
  const double pxx = stress_[0][e], pxy = stress_[1][e], pyx = stress_[2][e], pyy = stress_[3][e];
  const double volume = fxx * fyy - fxy * fyx;
  const double xy = (pxx * fyx + pxy * fyy + pyx * fxx + pyy * fxy) / 2;
  return {(pxx * fxx + pxy * fxy) / volume, (pyx * fyx + pyy * fyy) / volume, xy / volume};
}

std::array<double, 3> Deformation::cauchy(const Model& model, std::size_t body) const {
  std::array<double, 3> sum{0, 0, 0};
  const Body& b = model.bodies[body];
  if (b.element_end == b.element_begin + 1) return cauchy_of_element(model.body_element[b.element_begin]);
  for (std::uint32_t i = b.element_begin; i < b.element_end; ++i) {
    const std::uint32_t e = model.body_element[i];
    const std::array<double, 3> stress = cauchy_of_element(e);
    for (std::size_t k = 0; k < 3; ++k) sum[k] += model.elements[e].area / b.moments.area * stress[k];
  }
  return sum;
}

std::vector<double> Deformation::memory() const {
  std::vector<double> all;
  for (const std::vector<double>& component : deformation_)
    all.insert(all.end(), component.begin(), component.end());
  for (const Batch& batch : batches_) all.insert(all.end(), batch.state.begin(), batch.state.end());
  return all;
}

void Deformation::set_memory(const std::vector<double>& memory) {
  const double* from = memory.data();
  const auto take = [&](std::vector<double>& to) {
    std::copy(from, from + to.size(), to.begin());
    from += to.size();
  };
  for (std::vector<double>& component : deformation_) take(component);
  for (Batch& batch : batches_) take(batch.state);
}

}  // namespace talus
