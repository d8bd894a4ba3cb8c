#include "simulation/deformation.hpp"

#include <limits>

namespace talus {

Deformation::Deformation(const Scene& scene, const Model& model) : element_of_(model.bodies.size(), -1) {
  const std::size_t count = model.element_body.size();
  for (std::size_t e = 0; e < count; ++e) element_of_[model.element_body[e]] = static_cast<std::int64_t>(e);
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
  for (std::size_t e = 0; e < model.element_body.size(); ++e) {
    const Matrix2& h = motion.bodies[model.element_body[e]].h;
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
  for (std::size_t e = 0; e < model.element_body.size(); ++e) {
    const std::uint32_t body = model.element_body[e];
    const double area = model.bodies[body].moments.area;
    Matrix2& moment = motion.forces[body].moment;
    moment.xx -= area * stress_[0][e];
    moment.xy -= area * stress_[1][e];
    moment.yx -= area * stress_[2][e];
    moment.yy -= area * stress_[3][e];
    total.stored += area * energy_[e];
    total.dissipated += area * dissipated_[e];
  }
  return total;
}

/// σ = P Fᵀ / det F.
std::array<double, 3> Deformation::cauchy(std::size_t body) const {
  if (element_of_[body] < 0) return {0, 0, 0};
  const auto e = static_cast<std::size_t>(element_of_[body]);
  const double fxx = deformation_[0][e], fxy = deformation_[1][e], fyx = deformation_[2][e],
               fyy = deformation_[3][e];
  const double pxx = stress_[0][e], pxy = stress_[1][e], pyx = stress_[2][e], pyy = stress_[3][e];
  const double volume = fxx * fyy - fxy * fyx;
  const double xy = (pxx * fyx + pxy * fyy + pyx * fxx + pyy * fxy) / 2;
  return {(pxx * fxx + pxy * fxy) / volume, (pyx * fyx + pyy * fyy) / volume, xy / volume};
}

}  // namespace talus
