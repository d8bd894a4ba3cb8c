// A toy law that is small and whole: a corner of one piece inside another is pushed out through the nearest
// boundary side with the force k d², d its depth; the ends of that side carry the reaction. No friction, no
// history. The force is the gradient of the energy k d³/3.
#include <talus/library.hpp>

#include <cmath>
#include <limits>
#include <optional>

namespace {

using talus::Boundaries;
using talus::ContactBatch;
using talus::ContactLoads;

constexpr talus::Parameter interface_parameters[] = {
    talus::number("normal_stiffness", "Pa/m", talus::required, 0, talus::unbounded,
                  "Force per square of the depth of a corner.")};

/// A piece moved into the frame of the pair.
struct Piece {
  const Boundaries& boundaries;
  std::uint32_t start, end;
  double offset_x, offset_y;
  std::uint32_t load_start;

  double x(std::uint32_t corner) const { return boundaries.corner[corner].x + offset_x; }
  double y(std::uint32_t corner) const { return boundaries.corner[corner].y + offset_y; }
  std::uint32_t after(std::uint32_t corner) const { return corner + 1 == end ? start : corner + 1; }
  std::uint32_t load(std::uint32_t corner) const { return load_start + corner - start; }
};

/// Where a point lies within a piece: the side nearest to it, of those that are boundary.
struct Depth {
  std::uint32_t side;
  double depth;               ///< m
  double share;               ///< of the side's length, from its first end to the foot of the point
  double normal_x, normal_y;  ///< outward
};

std::optional<Depth> depth_in(const Piece& piece, double x, double y) {
  Depth nearest{0, std::numeric_limits<double>::infinity(), 0, 0, 0};
  for (std::uint32_t side = piece.start; side < piece.end; ++side) {
    const double ex = piece.x(piece.after(side)) - piece.x(side),
                 ey = piece.y(piece.after(side)) - piece.y(side);
    const double dx = x - piece.x(side), dy = y - piece.y(side), length = std::hypot(ex, ey);
    const double depth = (ex * dy - ey * dx) / length;
    if (depth <= 0) return std::nullopt;
    if (depth < nearest.depth && piece.boundaries.corner[side].surface != talus::internal_side) {
      nearest = {side, depth, (ex * dx + ey * dy) / (length * length), ey / length, -ex / length};
    }
  }
  return nearest;
}

class SoftCorner final : public talus::ContactModel {
 public:
  explicit SoftCorner(const double* /*values*/) {}

  std::uint32_t doubles_per_contact() const noexcept override { return 0; }

  void evaluate(const ContactBatch& batch, const ContactLoads& loads) const noexcept override {
    for (std::uint32_t k = 0; k < batch.active_count; ++k) {
      const std::uint32_t i = batch.active[k];
      const talus::BodyPair& pair = batch.pairs[i];
      loads.pairs[i] = {};
      for (const talus::PiecePair pieces : batch.piece_pairs.of(pair)) {
        const std::uint32_t* start = batch.boundaries.piece_start;
        const Piece a{batch.boundaries, start[pieces.a], start[pieces.a + 1], 0, 0, pieces.load_start};
        const Piece b{batch.boundaries, start[pieces.b], start[pieces.b + 1],
                      pair.offset_x,    pair.offset_y,   pieces.load_start + a.end - a.start};
        for (std::uint32_t load = a.load_start; load < b.load(b.end); ++load) loads.corner[load] = {0, 0};
        push_out(a, b, 1, batch, pair, loads, loads.pairs[i]);
        push_out(b, a, -1, batch, pair, loads, loads.pairs[i]);
      }
    }
  }

  talus::ContactStiffness stiffness(const double* values, double length) const noexcept override {
    return {values[0] * length, 0, 0, 0};  // 2 k d, and d stays below half the side
  }

 private:
  /// Corners of `slave` out of `master`. `to_b` is 1 if the slave belongs to body b, -1 otherwise.
  static void push_out(const Piece& master, const Piece& slave, double to_b, const ContactBatch& batch,
                       const talus::BodyPair& pair, const ContactLoads& loads, talus::PairReport& report) {
    const talus::Interfaces& interfaces = batch.interfaces;
    for (std::uint32_t corner = slave.start; corner < slave.end; ++corner) {
      const std::uint32_t surface = batch.boundaries.corner[corner].surface;
      const auto at = depth_in(master, slave.x(corner), slave.y(corner));
      if (!at || surface == talus::internal_side) continue;
      const std::uint32_t opposite = batch.boundaries.corner[at->side].surface;
      const std::uint32_t row = interfaces.row[opposite * interfaces.surface_count + surface];
      const double stiffness = interfaces.value[row * interfaces.parameter_count];
      const double force = stiffness * at->depth * at->depth;
      const double fx = force * at->normal_x, fy = force * at->normal_y;
      add(loads, slave.load(corner), fx, fy, 1);
      add(loads, master.load(at->side), fx, fy, at->share - 1);
      add(loads, master.load(master.after(at->side)), fx, fy, -at->share);

      if (report.contact_count < pair.slot_capacity && loads.reports != nullptr) {
        loads.reports[pair.slot_start + report.contact_count] = {
            slave.x(corner), slave.y(corner), to_b * fx, to_b * fy, 0, 0, at->depth, 0, 0};
      }
      ++report.contact_count;
      report.penetration = std::fmax(report.penetration, at->depth);
      report.stored += force * at->depth / 3;
    }
  }

  static void add(const ContactLoads& loads, std::uint32_t load, double fx, double fy, double share) {
    loads.corner[load].x += share * fx;
    loads.corner[load].y += share * fy;
  }
};

constexpr talus::Component components[] = {talus::contact_model<SoftCorner>(
    "soft_corner", "Corners pushed out with a force quadratic in their depth.", {}, interface_parameters)};

}  // namespace

TALUS_EXPORT const talus::Library talus_library =
    talus::library("soft_corner", "1.0", "somebody else", components);
