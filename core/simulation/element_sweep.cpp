#include "simulation/element_sweep.hpp"

#include <algorithm>

namespace talus {
namespace {

static_assert(sizeof(Vec2) == 2 * sizeof(double));

double* flat(std::vector<Vec2>& values, std::size_t patch) {
  return &values[patch].x;
}

using kernels::LocalVectors;

/// Over twice as many values as there are patches.
LocalVectors local_vectors(std::vector<double>& values, bool apart) {
  double* first = values.data();
  return apart ? LocalVectors{first, first + values.size() / 2, 1} : LocalVectors{first, first + 1, 2};
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

using Four = std::array<double*, 4>;

Four rows(double (&component)[4][ElementBuffer::most]) {
  return {component[0], component[1], component[2], component[3]};
}

kernels::Triangles triangles_of(const Partition& partition, const ElementChunk& chunk) {
  kernels::Triangles t{};
  for (std::size_t k = 0; k < 3; ++k) t.corner[k] = partition.corner[k].data() + chunk.triangle;
  for (std::size_t k = 0; k < 4; ++k) t.gradient[k] = partition.gradient[k].data() + chunk.triangle;
  t.area = partition.area.data() + chunk.triangle;
  return t;
}

}  // namespace

ElementSweep::ElementSweep(const Model& model, SimdLevel level)
    : kernels_(kernels::element_kernels(level)), slot_(model.partition.slot_patch.size()) {
  for (const Subdomain& subdomain : model.partition.subdomains)
    most_patches_ = std::max<std::size_t>(most_patches_, subdomain.patch_count);
}

ElementSweep::Workspace ElementSweep::workspace() const {
  Workspace w;
  for (auto* values : {&w.displacement, &w.force}) values->resize(2 * most_patches_);
  return w;
}

void ElementSweep::run(const Model& model, const Body& body, std::uint32_t begin, std::uint32_t end,
                       const SweepStep& step, MaterialBatches& materials, MotionState& motion, Workspace& w,
                       std::vector<SweepSums>& sums) {
  const Partition& partition = model.partition;
  const RegularLattice& lattice = partition.lattices[body.lattice];
  const std::uint32_t first = model.first_element(body);
  const std::uint32_t batch = materials.batch_of(first);
  const Four f = rows(w.elements.deformation), p = rows(w.elements.stress);
  const bool apart = lattice.area > 0;
  const LocalVectors at = local_vectors(w.displacement, apart), force = local_vectors(w.force, apart);

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
    kernels_.accelerate(run.count, step.velocity, run.same_mass, model.patch_mass.data() + run.patch,
                        step.inverse_mass + run.patch, force.from(run.local),
                        flat(motion.patch_velocity, run.patch),
                        step.keep ? &step.middle[run.patch].x : nullptr, step.share, sum.own);
  };

  for (std::uint32_t s = begin; s < end; ++s) {
    const Subdomain& subdomain = partition.subdomains[s];
    for (std::uint32_t i = subdomain.slot_begin; i < subdomain.slot_end; ++i) {
      set(at, partition.slot_local[i], motion.patch_displacement[partition.slot_patch[i]]);
      set(force, partition.slot_local[i], {});
    }
    // Own patches enter when the first element needs them and leave after the last one: they are read from
    // memory and written to it once.
    std::uint32_t entered = subdomain.run_begin, left = subdomain.run_begin;

    SweepSums& sum = sums[s];
    sum = {};
    for (std::uint32_t c = subdomain.chunk_begin; c < subdomain.chunk_end; ++c) {
      const ElementChunk& chunk = partition.chunks[c];
      const std::uint32_t bottom = chunk.bottom, top = chunk.top;
      for (; entered < chunk.run_needed; ++entered) enter(partition.runs[entered]);
      if (chunk.cells > 0) {
        kernels_.lattice_gradient(chunk.cells, lattice.gradient.data(), at.x + bottom, at.y + bottom,
                                  at.x + top, at.y + top, f.data());
      } else {
        kernels_.triangle_gradient(chunk.count, triangles_of(partition, chunk), at, f.data());
      }
      materials.evaluate(batch, first + chunk.element, chunk.count, step.dt, step.keep, w.elements);
      if (chunk.cells > 0) {
        kernels_.lattice_force(chunk.cells, lattice.gradient.data(), lattice.area, p.data(), force.x + bottom,
                               force.y + bottom, force.x + top, force.y + top);
        sum.stored += lattice.area * kernels_.sum(chunk.count, w.elements.energy);
        sum.dissipated += lattice.area * kernels_.sum(chunk.count, w.elements.dissipated);
      } else {
        const kernels::Triangles triangles = triangles_of(partition, chunk);
        kernels_.triangle_force(chunk.count, triangles, p.data(), force);
        sum.stored += kernels_.weighted_sum(chunk.count, triangles.area, w.elements.energy);
        sum.dissipated += kernels_.weighted_sum(chunk.count, triangles.area, w.elements.dissipated);
      }
      for (; left < chunk.run_done; ++left) leave(partition.runs[left], sum);
    }

    for (std::uint32_t i = subdomain.slot_begin; i < subdomain.slot_end; ++i)
      slot_[i] = vector_of(force, partition.slot_local[i]);
  }
}

void ElementSweep::gather(const Model& model, const Body& body, std::uint32_t begin, std::uint32_t end,
                          MotionState& motion) const {
  const Partition& partition = model.partition;
  for (std::uint32_t i = begin; i < end; ++i) {
    const std::uint32_t common = body.common_index + i;
    Vec2& force = motion.patch_force[body.own_end + i];
    for (std::uint32_t k = partition.common_start[common]; k < partition.common_start[common + 1]; ++k) {
      force.x += slot_[partition.common_slot[k]].x;
      force.y += slot_[partition.common_slot[k]].y;
    }
  }
}

}  // namespace talus
