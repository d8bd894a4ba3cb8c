#pragma once

#include <talus/overlap/cell_loads.hpp>

#include <concepts>

namespace talus::overlap {

/// Normal pressure behind a side.
struct Pressure {
  double value;  ///< Pa
  double slope;  ///< Pa/m, its derivative by the depth
};

/// A law that has another pressure than α_N g: `law.pressure(interface, depth)`, zero at depth 0 and nowhere
/// falling.
template <class Law>
concept HasOwnPressure = requires(const Law& law, const InterfaceParameters& interface, double depth) {
  { law.pressure(interface, depth) } -> std::same_as<Pressure>;
};

/// What a pressure p(g) in a cell makes of a side, g the depth behind it.
struct CellPressure {
  double load;    ///< N/m, ∫ p′ dA: the derivative of the energy as the side moves inwards
  double energy;  ///< J/m, ∫ p dA
  Point centre;   ///< of the load
};

/// Triangle by triangle, six points in each: exact for pressures of fourth degree. With a bend or a root in
/// the pressure the sums depend on how cells fall into triangles, as `talus check-plugin` will tell. Friction
/// and reports go by them, the pressure itself by sums over sides: by 0.2 % more for p = α g^1.5.
template <class Law>
CellPressure integrate(const Law& law, const InterfaceParameters& interface, const Piece& master,
                       std::uint32_t side, const Polygon& cell) {
  struct Orbit {
    double weight, near;
  };
  constexpr Orbit orbits[] = {{0.22338158967801146570, 0.44594849091596488632},
                              {0.10995174365532186764, 0.09157621350977074346}};
  const Point origin = cell[0].at;
  CellPressure result{0, 0, origin};
  Point moment{0, 0};
  for (std::size_t i = 1; i + 1 < cell.size(); ++i) {
    const Point p = cell[i].at - origin, q = cell[i + 1].at - origin;
    const double area = std::max(0.0, cross(p, q)) / 2;
    for (const Orbit& orbit : orbits) {
      const double far = 1 - 2 * orbit.near;
      for (const Point at : {orbit.near * (p + q), orbit.near * p + far * q, far * p + orbit.near * q}) {
        const Pressure pressure = law.pressure(interface, std::max(0.0, master.depth(side, origin + at)));
        const double part = orbit.weight * area * pressure.slope;
        result.load += part;
        result.energy += orbit.weight * area * pressure.value;
        moment = moment + part * at;
      }
    }
  }
  result.centre = result.load > 0 ? origin + (1 / result.load) * moment : area_centroid(cell).centroid;
  return result;
}

/// The pressure along a segment as loads at its two ends, N/m: three points of Gauss, exact for fourth
/// degree.
template <class Law>
void integrate(const Law& law, const InterfaceParameters& interface, const Segment& segment,
               double loads[2]) {
  constexpr double half = 0.38729833462074168852;  // √0.6 / 2
  constexpr double points[] = {0.5 - half, 0.5, 0.5 + half}, weights[] = {5 / 18.0, 8 / 18.0, 5 / 18.0};
  loads[0] = loads[1] = 0;
  for (int k = 0; k < 3; ++k) {
    const double depth = (1 - points[k]) * segment.depth[0] + points[k] * segment.depth[1];
    const double part = weights[k] * segment.length * law.pressure(interface, depth).value;
    loads[0] += (1 - points[k]) * part;
    loads[1] += points[k] * part;
  }
}

/// Eqs. 30–32 (with the factor 3 that Eq. 31 misses), as end loads: l/6 (2p₁+p₂) and l/6 (p₁+2p₂).
template <class Law>
void find_slave_loads(const Law& law, const InterfaceParameters& parameters, double share, Segment& segment) {
  if constexpr (HasOwnPressure<Law>) {
    integrate(law, parameters, segment, segment.load);
    for (double& load : segment.load) load *= share;
  } else {
    const double stiffness = share * parameters.normal_stiffness;
    for (int end = 0; end < 2; ++end)
      segment.load[end] = stiffness * segment.length * (2 * segment.depth[end] + segment.depth[1 - end]) / 6;
  }
}

}  // namespace talus::overlap
