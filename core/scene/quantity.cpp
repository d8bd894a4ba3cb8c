#include "scene/quantity.hpp"

#include <algorithm>
#include <array>

namespace talus {

namespace {

using What = Quantity::What;
using Of = Quantity::Of;

constexpr std::array all_quantities{
    Quantity{What::ux, "ux", "m", "displacement along x since t = 0"},
    Quantity{What::uy, "uy", "m", "displacement along y since t = 0"},
    Quantity{What::displacement, "displacement", "m", "length of the displacement since t = 0"},
    Quantity{What::vx, "vx", "m/s", "velocity along x"},
    Quantity{What::vy, "vy", "m/s", "velocity along y"},
    Quantity{What::speed, "speed", "m/s", "length of the velocity"},
    Quantity{What::rotation, "rotation", "deg",
             "rotation since t = 0, counter-clockwise: mean over the body, whatever `point`"},
    Quantity{What::x, "x", "m", "position, with the scene's origin"},
    Quantity{What::y, "y", "m", "position, with the scene's origin"},
    Quantity{
        What::stress_xx, "stress_xx", "Pa",
        "Cauchy stress: mean over the body as it was drawn, or of the element at `point`; 0 for rigid bodies",
        Of::stress},
    Quantity{
        What::stress_yy, "stress_yy", "Pa",
        "Cauchy stress: mean over the body as it was drawn, or of the element at `point`; 0 for rigid bodies",
        Of::stress},
    Quantity{
        What::stress_xy, "stress_xy", "Pa",
        "Cauchy stress: mean over the body as it was drawn, or of the element at `point`; 0 for rigid bodies",
        Of::stress},
    Quantity{What::contact_fx, "contact_fx", "N/m",
             "force along x of all contacts on the body, e.g. the thrust on a fixed wall", Of::contacts},
    Quantity{What::contact_fy, "contact_fy", "N/m", "force along y of all contacts on the body",
             Of::contacts},
    Quantity{What::contact_moment, "contact_moment", "N",
             "their moment about `point`, or about the centre of mass, counter-clockwise", Of::contacts},
};

bool sees(const Monitor& monitor, Of what) {
  return std::any_of(monitor.quantities.begin(), monitor.quantities.end(),
                     [what](const std::string& name) { return find_quantity(name)->of == what; });
}

}  // namespace

std::span<const Quantity> quantities() {
  return all_quantities;
}

const Quantity* find_quantity(std::string_view name) {
  for (const Quantity& quantity : all_quantities) {
    if (name == quantity.name) return &quantity;
  }
  return nullptr;
}

bool sees_contacts(const Monitor& monitor) {
  return sees(monitor, Of::contacts);
}

bool sees_stress(const Monitor& monitor) {
  return sees(monitor, Of::stress);
}

}  // namespace talus
