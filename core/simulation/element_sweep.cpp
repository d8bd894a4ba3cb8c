#include "simulation/element_sweep.hpp"

#include <algorithm>
#include <cstdint>

namespace talus {
namespace {

static_assert(sizeof(Vec2) == 2 * sizeof(double));

double* flat(std::vector<Vec2>& values, std::size_t patch) {
  return &values[patch].x;
}

using kernels::LocalVectors;

constexpr std::size_t line = 64 / sizeof(double);  ///< doubles in a line of the cache

/// Rows for `patches` patches, a multiple of a line, that start where a line does: packs of rows do not
/// straddle.
LocalVectors local_vectors(std::vector<double>& values, std::size_t patches, bool apart) {
  const std::size_t off = reinterpret_cast<std::uintptr_t>(values.data()) / sizeof(double) % line;
  double* first = values.data() + (line - off) % line;
  return apart ? LocalVectors{first, first + patches, 1} : LocalVectors{first, first + 1, 2};
}

Vec2 vector_of(const LocalVectors& vectors, std::uint32_t patch) {
  const LocalVectors at = vectors.from(patch);
  return {*at.x, *at.y};
}
void set(const LocalVectors& vectors, std::uint32_t patch, Vec2 value) {
  const LocalVectors at = vectors.from(patch);
  *at.x = value.x;
  *at.y = value.y;
}
void clear(const LocalVectors& vectors, std::uint32_t count) {
  std::fill_n(vectors.x, vectors.stride * count, 0.0);
  if (vectors.apart()) std::fill_n(vectors.y, count, 0.0);
}

void fetch(const MotionState& motion, const PatchRun& run) {
  constexpr std::uint32_t in_line = 64 / sizeof(Vec2);
  for (std::uint32_t i = 0; i < run.count; i += in_line) {
    __builtin_prefetch(&motion.patch_displacement[run.patch + i], 1);
    __builtin_prefetch(&motion.patch_velocity[run.patch + i], 1);
  }
}

/// Displacements and velocities of own patches, which lie in the order of their runs.
RowsAhead rows_ahead(const MotionState& motion, const Partition& partition, std::uint32_t run) {
  const std::uint32_t patch = run < partition.runs.size() ? partition.runs[run].patch : 0;
  return {{&motion.patch_displacement[patch].x, &motion.patch_velocity[patch].x}};
}

using Four = std::array<double*, 4>;

Four rows(double (&component)[4][ElementBuffer::most]) {
  return {component[0], component[1], component[2], component[3]};
}

LatticeCells cells_of(const RegularLattice& lattice, const ElementChunk& chunk, const LocalVectors& at,
                      const LocalVectors& force, const RowsAhead& ahead) {
  const LocalVectors bottom = at.from(chunk.bottom), top = at.from(chunk.top),
                     on_bottom = force.from(chunk.bottom), on_top = force.from(chunk.top);
  LatticeCells cells{chunk.cells, {},          lattice.area, bottom.x, bottom.y, top.x,
                     top.y,       on_bottom.x, on_bottom.y,  on_top.x, on_top.y, ahead};
  std::copy(lattice.gradient.begin(), lattice.gradient.end(), cells.gradient);
  return cells;
}

TriangleChain chain_of(const Partition& partition, const ElementChunk& chunk, const LocalVectors& at,
                       const LocalVectors& force, const RowsAhead& ahead) {
  TriangleChain chain{chunk.links,
                      at.stride - 1,
                      partition.corner.data() + chunk.link,
                      {},
                      partition.area.data() + chunk.link,
                      at.x,
                      at.y,
                      force.x,
                      force.y,
                      ahead};
  for (std::size_t k = 0; k < 4; ++k) chain.gradient[k] = partition.gradient[k].data() + chunk.link;
  return chain;
}

}  // namespace

ElementSweep::ElementSweep(const Model& model, SimdLevel level)
    : kernels_(kernels::element_kernels(level)), slot_(model.partition.slot_patch.size()) {
  for (const Subdomain& subdomain : model.partition.subdomains)
    most_patches_ = std::max<std::size_t>(most_patches_, (subdomain.patch_count + line - 1) / line * line);
}

ElementSweep::Workspace ElementSweep::workspace() const {
  Workspace w;
  for (auto* values : {&w.displacement, &w.force}) values->resize(2 * most_patches_ + line);
  return w;
}

void ElementSweep::run(const Model& model, const Body& body, std::uint32_t begin, std::uint32_t end,
                       const SweepStep& step, MaterialBatches& materials, MotionState& motion, Workspace& w,
                       std::vector<SweepSums>& sums) {
  const CoverRanges& ranges = model.ranges(body);
  const Partition& partition = model.partition;
  const RegularLattice& lattice = partition.lattices[ranges.lattice];
  const std::uint32_t first = model.first_element(body);
  const std::uint32_t batch = materials.batch_of(first);
  const Material* const sweeping = materials.sweeping(batch);
  const Four f = rows(w.elements.deformation), p = rows(w.elements.stress);
  const bool apart = lattice.area > 0;
  const LocalVectors at = local_vectors(w.displacement, most_patches_, apart),
                     force = local_vectors(w.force, most_patches_, apart);

  const auto enter = [&](const PatchRun& run) {
    kernels_.move(run.count, motion.own_behind, flat(motion.patch_displacement, run.patch),
                  flat(motion.patch_velocity, run.patch), at.from(run.local));
    clear(force.from(run.local), run.count);
  };
  const auto leave = [&](const PatchRun& run, SweepSums& sum) {
    if (!step.update) {
      for (std::uint32_t i = 0; i < run.count; ++i)
        motion.patch_force[run.patch + i] = vector_of(force, run.local + i);
      return;
    }
    const bool same = run.mass > 0;
    const double inverse = same ? 1 / run.mass : 0;
    kernels_.accelerate(run.count, step.velocity, same,
                        same ? &run.mass : model.patch_mass.data() + run.patch,
                        same ? &inverse : step.inverse_mass + run.patch, force.from(run.local),
                        flat(motion.patch_velocity, run.patch),
                        step.keep ? &step.middle[run.patch].x : nullptr, step.share, sum.own);
  };

  for (std::uint32_t s = begin; s < end; ++s) {
    const Subdomain& subdomain = partition.subdomains[s];
    // Patches enter when the first element needs them and leave after the last one: they are read from memory
    // and written to it once, and leave their places to others.
    std::uint32_t entered = subdomain.run_begin, left = subdomain.run_begin;
    std::uint32_t slot_entered = subdomain.slot_begin, slot_left = subdomain.slot_begin;

    SweepSums& sum = sums[s];
    sum = {};
    for (std::uint32_t c = subdomain.chunk_begin; c < subdomain.chunk_end; ++c) {
      const ElementChunk& chunk = partition.chunks[c];
      const std::uint32_t bottom = chunk.bottom, top = chunk.top;
      for (; entered < chunk.run_needed; ++entered) enter(partition.runs[entered]);
      for (; slot_entered < chunk.slot_needed; ++slot_entered) {
        set(at, partition.slot_local[slot_entered],
            motion.patch_displacement[partition.slot_patch[slot_entered]]);
        set(force, partition.slot_local[slot_entered], {});
      }
      // What the next chunk needs comes from memory while this one is worked on: a sweep fetches it along the
      // way.
      for (std::uint32_t r = entered;
           sweeping == nullptr && c + 1 < subdomain.chunk_end && r < partition.chunks[c + 1].run_needed; ++r)
        fetch(motion, partition.runs[r]);
      const RowsAhead ahead = rows_ahead(motion, partition, entered);
      const bool cells = chunk.cells > 0;
      const TriangleChain chain = cells ? TriangleChain{} : chain_of(partition, chunk, at, force, ahead);
      if (sweeping == nullptr || step.keep) {
        if (cells) {
          kernels_.lattice_gradient(chunk.cells, lattice.gradient.data(), at.x + bottom, at.y + bottom,
                                    at.x + top, at.y + top, f.data());
        } else {
          kernels_.chain_gradient(chain, f.data());
        }
        sum.inside_out = sum.inside_out || (step.keep && w.elements.any_inside_out(chunk.count));
      }
      // A material that goes on to the forces by itself is asked for stress where that is kept alone.
      if (sweeping == nullptr || (step.keep && materials.keeps_stress())) {
        materials.evaluate(batch, first + chunk.element, chunk.count, step.dt, step.keep, w.elements);
      }
      if (sweeping != nullptr) {
        sum.stored +=
            cells ? sweeping->sweep(cells_of(lattice, chunk, at, force, ahead)) : sweeping->sweep(chain);
      } else if (cells) {
        kernels_.lattice_force(chunk.cells, lattice.gradient.data(), lattice.area, p.data(), force.x + bottom,
                               force.y + bottom, force.x + top, force.y + top);
        sum.stored += lattice.area * kernels_.sum(chunk.count, w.elements.energy);
        sum.dissipated += lattice.area * kernels_.sum(chunk.count, w.elements.dissipated);
      } else {
        kernels_.chain_force(chain, p.data());
        sum.stored += kernels_.chain_sum(chain, w.elements.energy);
        sum.dissipated += kernels_.chain_sum(chain, w.elements.dissipated);
      }
      for (; left < chunk.run_done; ++left) leave(partition.runs[left], sum);
      for (; slot_left < chunk.slot_done; ++slot_left)
        slot_[slot_left] = vector_of(force, partition.slot_local[slot_left]);
    }
  }
}

void ElementSweep::gather(const Model& model, const Body& body, std::uint32_t begin, std::uint32_t end,
                          MotionState& motion) const {
  const CoverRanges& ranges = model.ranges(body);
  const Partition& partition = model.partition;
  for (std::uint32_t i = begin; i < end; ++i) {
    const std::uint32_t common = ranges.common_index + i;
    Vec2& force = motion.patch_force[ranges.own_end + i];
    for (std::uint32_t k = partition.common_start[common]; k < partition.common_start[common + 1]; ++k) {
      force.x += slot_[partition.common_slot[k]].x;
      force.y += slot_[partition.common_slot[k]].y;
    }
  }
}

void ElementSweep::update_common(const Model& model, const Body& body, std::uint32_t begin, std::uint32_t end,
                                 const SweepStep& step, MotionState& motion,
                                 kernels::VelocitySums& sums) const {
  const CoverRanges& ranges = model.ranges(body);
  const std::uint32_t first = ranges.own_end + begin;
  double* const force = flat(motion.patch_force, first);
  kernels_.accelerate(end - begin, step.velocity, false, model.patch_mass.data() + first,
                      step.inverse_mass + first, {force, force + 1, 2}, flat(motion.patch_velocity, first),
                      step.keep ? &step.middle[first].x : nullptr, step.share, sums);
}

}  // namespace talus
