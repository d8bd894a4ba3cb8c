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

/// One thread on its way over subdomains of a body. Patches enter when the first element needs them and leave
/// after the last one: they are read from memory and written to it once, and leave their places to others.
class ElementSweep::Pass {
 public:
  Pass(ElementSweep& all, const Model& model, const Body& body, const SweepStep& step,
       MaterialBatches& materials, MotionState& motion, Workspace& w)
      : all_(all),
        model_(model),
        partition_(model.partition),
        lattice_(partition_.lattices[model.ranges(body).lattice]),
        first_(model.first_element(body)),
        step_(step),
        materials_(materials),
        batch_(materials.batch_of(first_)),
        sweeping_(materials.sweeping(batch_)),
        motion_(motion),
        elements_(w.elements),
        f_(rows(w.elements.deformation)),
        p_(rows(w.elements.stress)),
        at_(local_vectors(w.displacement, all.most_patches_, lattice_.area > 0)),
        force_(local_vectors(w.force, all.most_patches_, lattice_.area > 0)) {}

  void over(const Subdomain& subdomain, SweepSums& sum) {
    entered_ = left_ = subdomain.run_begin;
    slot_entered_ = slot_left_ = subdomain.slot_begin;
    sum = {};
    for (std::uint32_t c = subdomain.chunk_begin; c < subdomain.chunk_end; ++c) {
      const ElementChunk& chunk = partition_.chunks[c];
      enter(chunk);
      if (sweeping_ == nullptr && c + 1 < subdomain.chunk_end) fetch_for(partition_.chunks[c + 1]);
      const RowsAhead ahead = rows_ahead(motion_, partition_, entered_);
      if (chunk.cells > 0) {
        strain_and_load(chunk, cells_of(lattice_, chunk, at_, force_, ahead), sum);
      } else {
        strain_and_load(chunk, chain_of(partition_, chunk, at_, force_, ahead), sum);
      }
      leave(chunk, sum);
    }
  }

 private:
  void enter(const ElementChunk& chunk) {
    for (; entered_ < chunk.run_needed; ++entered_) {
      const PatchRun& run = partition_.runs[entered_];
      all_.kernels_.move(run.count, motion_.own_behind, flat(motion_.patch_displacement, run.patch),
                         flat(motion_.patch_velocity, run.patch), at_.from(run.local));
      clear(force_.from(run.local), run.count);
    }
    for (; slot_entered_ < chunk.slot_needed; ++slot_entered_) {
      set(at_, partition_.slot_local[slot_entered_],
          motion_.patch_displacement[partition_.slot_patch[slot_entered_]]);
      set(force_, partition_.slot_local[slot_entered_], {});
    }
  }

  /// What the next chunk needs comes from memory while this one is worked on. A sweep of the material fetches
  /// it along the way.
  void fetch_for(const ElementChunk& next) const {
    for (std::uint32_t r = entered_; r < next.run_needed; ++r) fetch(motion_, partition_.runs[r]);
  }

  /// From displacements to forces of one chunk, of a lattice or of any triangles. A material that goes on to
  /// the forces by itself is asked for stress where that is kept alone.
  template <class Elements>
  void strain_and_load(const ElementChunk& chunk, const Elements& elements, SweepSums& sum) {
    if (sweeping_ == nullptr || step_.keep) {
      strain(elements);
      sum.inside_out = sum.inside_out || (step_.keep && elements_.any_inside_out(chunk.count));
    }
    if (sweeping_ == nullptr || (step_.keep && materials_.keeps_stress()))
      materials_.evaluate(batch_, first_ + chunk.element, chunk.count, step_.dt, step_.keep, elements_);
    if (sweeping_ != nullptr) {
      sum.stored += sweeping_->sweep(elements);
    } else {
      load(chunk, elements, sum);
    }
  }

  void strain(const LatticeCells& cells) const {
    all_.kernels_.lattice_gradient(cells.count, cells.gradient, cells.bottom_x, cells.bottom_y, cells.top_x,
                                   cells.top_y, f_.data());
  }
  void strain(const TriangleChain& chain) const { all_.kernels_.chain_gradient(chain, f_.data()); }

  void load(const ElementChunk& chunk, const LatticeCells& cells, SweepSums& sum) const {
    const kernels::ElementKernels& kernels = all_.kernels_;
    kernels.lattice_force(cells.count, cells.gradient, lattice_.area, p_.data(), cells.bottom_force_x,
                          cells.bottom_force_y, cells.top_force_x, cells.top_force_y);
    sum.stored += lattice_.area * kernels.sum(chunk.count, elements_.energy);
    sum.dissipated += lattice_.area * kernels.sum(chunk.count, elements_.dissipated);
    sum.viscous += lattice_.area * kernels.sum(chunk.count, elements_.viscous);
  }
  void load(const ElementChunk&, const TriangleChain& chain, SweepSums& sum) const {
    const kernels::ElementKernels& kernels = all_.kernels_;
    kernels.chain_force(chain, p_.data());
    sum.stored += kernels.chain_sum(chain, elements_.energy);
    sum.dissipated += kernels.chain_sum(chain, elements_.dissipated);
    sum.viscous += kernels.chain_sum(chain, elements_.viscous);
  }

  void leave(const ElementChunk& chunk, SweepSums& sum) {
    for (; left_ < chunk.run_done; ++left_) leave(partition_.runs[left_], sum);
    for (; slot_left_ < chunk.slot_done; ++slot_left_)
      all_.slot_[slot_left_] = vector_of(force_, partition_.slot_local[slot_left_]);
  }

  void leave(const PatchRun& run, SweepSums& sum) {
    if (!step_.update) {
      for (std::uint32_t i = 0; i < run.count; ++i)
        motion_.patch_force[run.patch + i] = vector_of(force_, run.local + i);
      return;
    }
    const bool same = run.mass > 0;
    const double inverse = same ? 1 / run.mass : 0;
    all_.kernels_.accelerate(run.count, step_.velocity, same,
                             same ? &run.mass : model_.patch_mass.data() + run.patch,
                             same ? &inverse : step_.inverse_mass + run.patch, force_.from(run.local),
                             flat(motion_.patch_velocity, run.patch),
                             step_.keep ? &step_.middle[run.patch].x : nullptr, step_.share, sum.own);
  }

  ElementSweep& all_;
  const Model& model_;
  const Partition& partition_;
  const RegularLattice& lattice_;
  std::uint32_t first_;  ///< element of the body
  const SweepStep& step_;
  MaterialBatches& materials_;
  std::uint32_t batch_;
  const Material* sweeping_;  ///< the material, where it goes from displacements to forces by itself
  MotionState& motion_;
  ElementBuffer& elements_;
  Four f_, p_;
  LocalVectors at_, force_;
  std::uint32_t entered_ = 0, left_ = 0;            ///< runs
  std::uint32_t slot_entered_ = 0, slot_left_ = 0;  ///< slots of common patches
};

void ElementSweep::run(const Model& model, const Body& body, std::uint32_t begin, std::uint32_t end,
                       const SweepStep& step, MaterialBatches& materials, MotionState& motion, Workspace& w,
                       std::vector<SweepSums>& sums) {
  Pass pass(*this, model, body, step, materials, motion, w);
  for (std::uint32_t s = begin; s < end; ++s) pass.over(model.partition.subdomains[s], sums[s]);
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
