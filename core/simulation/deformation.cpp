#include "simulation/deformation.hpp"

#include "simulation/patch_mass.hpp"

#include <algorithm>

namespace talus {
namespace {

constexpr std::uint32_t gather_chunk = 1024;     ///< common patches
constexpr std::uint32_t elements_at_once = 512;  ///< at least, for a thread to take

void add(kernels::VelocitySums& total, const kernels::VelocitySums& part) {
  total.before += part.before;
  total.across += part.across;
  total.after += part.after;
  total.momentum[0] += part.momentum[0];
  total.momentum[1] += part.momentum[1];
}

/// With equal steps, no damping and no gravity the kinetic energy needs one product alone.
bool wants_all_sums(const StepConditions& c) {
  const bool pulled =
      c.gravity.x != 0 || c.gravity.y != 0 || c.gravity_behind.x != 0 || c.gravity_behind.y != 0;
  return c.dt_behind != c.dt_ahead || c.damping > 0 || pulled;
}

Deformation::Energy sum_of(const Deformation::Energy& p, const Deformation::Energy& q) {
  return {p.stored + q.stored, p.dissipated + q.dissipated, p.inside_out || q.inside_out};
}

}  // namespace

Deformation::Deformation(const Scene& scene, const Model& model, Workers& workers)
    : materials_(scene, model),
      sweep_(model, scene.simd),
      workers_(workers),
      workspaces_(static_cast<std::size_t>(workers.threads()), sweep_.workspace()),
      sums_(model.partition.subdomains.size()),
      free_(model.covered_bodies.empty() ? 0 : model.bodies.size()),
      updated_(free_.size()) {
  for (const std::uint32_t b : model.covered_bodies) {
    const CoverRanges& ranges = model.ranges(model.bodies[b]);
    subdomain_body_.resize(ranges.subdomain_end, b);
    const std::uint32_t count = ranges.patch_end - ranges.own_end;
    for (std::uint32_t begin = 0; begin < count; begin += gather_chunk)
      common_.push_back({b, begin, std::min(begin + gather_chunk, count)});
  }
  common_sums_.resize(common_.size());
  divide_sweeps(model);
  lay_out_blocks(model, {});
}

/// A loop costs a few microseconds to hand out: small bodies go together.
void Deformation::divide_sweeps(const Model& model) {
  const auto put = [](std::vector<Range>& ranges, std::uint32_t& work, std::uint32_t entry,
                      std::uint32_t more, std::uint32_t enough) {
    if (ranges.empty() || work >= enough) {
      ranges.push_back({entry, entry});
      work = 0;
    }
    ranges.back().end = entry + 1;
    work += more;
  };
  std::uint32_t elements = 0, patches = 0;
  for (std::uint32_t s = 0; s < subdomain_body_.size(); ++s) {
    const Subdomain& subdomain = model.partition.subdomains[s];
    std::uint32_t count = 0;
    for (std::uint32_t c = subdomain.chunk_begin; c < subdomain.chunk_end; ++c)
      count += model.partition.chunks[c].count;
    put(sweeps_, elements, s, count, elements_at_once);
  }
  for (std::uint32_t i = 0; i < common_.size(); ++i)
    put(gathers_, patches, i, common_[i].end - common_[i].begin, gather_chunk);
}

/// What sleeps is left out.
void Deformation::lay_out_blocks(const Model& model, std::span<const std::uint32_t> asleep) {
  blocks_.clear();
  for (std::uint32_t batch = 0; batch < materials_.count(); ++batch) {
    bool open = false;
    for (std::uint32_t e = materials_.begin(batch); e < materials_.end(batch); ++e) {
      const std::uint32_t body = model.element_body[e];
      const bool block = !model.covered(body) && (asleep.empty() || asleep[body] == 0);
      if (block && (!open || blocks_.back().count == ElementBuffer::most)) blocks_.push_back({batch, e, 0});
      if (block) ++blocks_.back().count;
      open = block;
    }
  }
  block_energies_.resize(blocks_.size());
}

void Deformation::set_asleep(const Model& model, std::span<const std::uint32_t> asleep) {
  lay_out_blocks(model, asleep);
}

double Deformation::stored_in(const Model& model, std::uint32_t index) const {
  const Body& body = model.bodies[index];
  return body.element_begin < body.element_end ? energies_[model.first_element(body)] : 0;
}

Deformation::Energy Deformation::apply(const Model& model, MotionState& motion, double dt, bool keep) {
  const Energy blocks = apply_to_blocks(model, dt, keep, motion);
  for (UpdatedPatches& updated : updated_) updated = {};
  sweep(model, {.dt = dt, .keep = keep}, motion);
  motion.own_behind = 0;
  return sum_of(blocks, energy_of_sweeps(model));
}

Deformation::Energy Deformation::apply_and_update(const Model& model, const PatchMass& mass,
                                                  std::span<const Support> supports,
                                                  const StepConditions& conditions, double dt, bool keep,
                                                  MotionState& motion, std::vector<Vec2>& at_step) {
  const Energy blocks = apply_to_blocks(model, dt, keep, motion);
  const Update update = update_of(conditions);
  for (const std::uint32_t b : model.covered_bodies) {
    free_[b] = support_of(supports, b).any() ? 0 : 1;
    updated_[b] = {free_[b] != 0 ? model.ranges(model.bodies[b]).free_end : 0, {}};
  }
  SweepStep step{.dt = dt, .keep = keep, .update = true};
  step.velocity = {
      update.keep, update.gain, {conditions.gravity.x, conditions.gravity.y}, wants_all_sums(conditions)};
  step.inverse_mass = mass.inverse().data();
  step.share = share_of_after(conditions);
  step.middle = at_step.data();
  sweep(model, step, motion);
  motion.own_behind = 0;
  return sum_of(blocks, energy_of_sweeps(model));
}

void Deformation::sweep(const Model& model, const SweepStep& given, MotionState& motion) {
  const auto step_of = [&](std::uint32_t body) {
    SweepStep step = given;
    step.update = given.update && free_[body] != 0;
    return step;
  };
  workers_.over(sweeps_.size(), 1, [&](std::size_t number, std::size_t, std::size_t, std::size_t thread) {
    const auto [begin, end] = sweeps_[number];
    for (std::uint32_t s = begin, next; s < end; s = next) {
      const std::uint32_t b = subdomain_body_[s];
      next = std::min(end, model.ranges(model.bodies[b]).subdomain_end);
      sweep_.run(model, model.bodies[b], s, next, step_of(b), materials_, motion, workspaces_[thread], sums_);
    }
  });
  workers_.over(gathers_.size(), 1, [&](std::size_t number, std::size_t, std::size_t) {
    for (std::uint32_t i = gathers_[number].begin; i < gathers_[number].end; ++i) {
      const auto [b, begin, end] = common_[i];
      const Body& body = model.bodies[b];
      const CoverRanges& ranges = model.ranges(body);
      sweep_.gather(model, body, begin, end, motion);
      common_sums_[i] = {};
      const SweepStep step = step_of(b);
      const std::uint32_t free_end = std::min(end, ranges.free_end - ranges.own_end);
      if (step.update && begin < free_end)
        sweep_.update_common(model, body, begin, free_end, step, motion, common_sums_[i]);
    }
  });
  if (!given.update) return;
  for (std::size_t s = 0; s < subdomain_body_.size(); ++s)
    add(updated_[subdomain_body_[s]].sums, sums_[s].own);
  for (std::size_t i = 0; i < common_.size(); ++i) add(updated_[common_[i].body].sums, common_sums_[i]);
}

Deformation::Energy Deformation::energy_of_sweeps(const Model& model) const {
  Energy total;
  for (std::size_t s = 0; s < model.partition.subdomains.size(); ++s) {
    const SweepSums& sums = sums_[s];
    total = sum_of(total, {sums.stored, sums.dissipated, sums.inside_out});
  }
  return total;
}

Deformation::Energy Deformation::apply_to_blocks(const Model& model, double dt, bool keep,
                                                 MotionState& motion) {
  workers_.over(blocks_.size(), 1, [&](std::size_t entry, std::size_t, std::size_t, std::size_t thread) {
    block_energies_[entry] = apply_to(model, blocks_[entry], dt, keep, workspaces_[thread].elements, motion);
  });
  Energy total;
  for (const Energy& part : block_energies_) total = sum_of(total, part);
  return total;
}

Deformation::Energy Deformation::apply_to(const Model& model, const Blocks& blocks, double dt, bool keep,
                                          ElementBuffer& buffer, MotionState& motion) {
  for (std::uint32_t i = 0; i < blocks.count; ++i) {
    const Matrix2& h = motion.bodies[model.element_body[blocks.element + i]].h;
    buffer.deformation[0][i] = 1 + h.xx;
    buffer.deformation[1][i] = h.xy;
    buffer.deformation[2][i] = h.yx;
    buffer.deformation[3][i] = 1 + h.yy;
  }
  materials_.evaluate(blocks.batch, blocks.element, blocks.count, dt, keep, buffer);
  Energy sum{.inside_out = keep && buffer.any_inside_out(blocks.count)};
  for (std::uint32_t i = 0; i < blocks.count; ++i) {
    const double area = model.element_area[blocks.element + i];
    sum.stored += area * buffer.energy[i];
    if (!energies_.empty()) energies_[blocks.element + i] = area * buffer.energy[i];
    sum.dissipated += area * buffer.dissipated[i];
    Matrix2& moment = motion.forces[model.element_body[blocks.element + i]].moment;
    moment.xx -= area * buffer.stress[0][i];
    moment.xy -= area * buffer.stress[1][i];
    moment.yx -= area * buffer.stress[2][i];
    moment.yy -= area * buffer.stress[3][i];
  }
  return sum;
}

std::array<double, 3> Deformation::cauchy(const Model& model, const MotionState& motion,
                                          std::size_t body) const {
  std::array<double, 3> sum{0, 0, 0};
  const Body& b = model.bodies[body];
  if (b.element_end == b.element_begin + 1)
    return cauchy_of_element(model, motion, model.body_element[b.element_begin]);
  std::array<Matrix2, ElementBuffer::most> gradients;
  std::array<std::array<double, 3>, ElementBuffer::most> stress;
  const std::uint32_t count = b.element_end - b.element_begin;
  for (std::uint32_t begin = 0; begin < count; begin += ElementBuffer::most) {
    const std::uint32_t first = model.first_element(b) + begin,
                        here = std::min(ElementBuffer::most, count - begin);
    for (std::uint32_t i = 0; i < here; ++i) gradients[i] = gradient_of_element(model, motion, first + i);
    materials_.cauchy(first, std::span(gradients).first(here), stress.data());
    for (std::uint32_t i = 0; i < here; ++i) {
      for (std::size_t k = 0; k < 3; ++k)
        sum[k] += model.element_area[first + i] / b.moments.area * stress[i][k];
    }
  }
  return sum;
}

}  // namespace talus
