#include "simulation/strain_mass.hpp"

namespace talus {
namespace {

Matrix2 plus(const Matrix2& p, double factor, const Matrix2& q) {
  return {p.xx + factor * q.xx, p.xy + factor * q.xy, p.yx + factor * q.yx, p.yy + factor * q.yy};
}

/// W Q, W a spin of 1 rad/s.
Matrix2 spun(const Matrix2& q) {
  return {-q.yx, -q.yy, q.xx, q.xy};
}

}  // namespace

StrainMass::StrainMass(const Body& body, double density, const Matrix2& h)
    : xx_(density * body.moments.xx),
      xy_(density * body.moments.xy),
      yy_(density * body.moments.yy),
      scale_(body.strain_mass_scale),
      shape_{1 + h.xx, h.xy, h.yx, 1 + h.yy},
      spin_(spun(shape_)),
      inertia_(inner(spin_, spin_)) {}

double StrainMass::inner(const Matrix2& p, const Matrix2& q) const {
  return p.xx * (xx_ * q.xx + xy_ * q.xy) + p.xy * (xy_ * q.xx + yy_ * q.xy) +
         (p.yx * (xx_ * q.yx + xy_ * q.yy) + p.yy * (xy_ * q.yx + yy_ * q.yy));
}

double StrainMass::product(const Matrix2& p, const Matrix2& q) const {
  return scale_ * inner(p, q) + (1 - scale_) * inner(spin_, p) * inner(spin_, q) / inertia_;
}

Matrix2 StrainMass::acceleration(const Matrix2& unscaled) const {
  const double angular = inner(spin_, unscaled) / inertia_;
  const Matrix2 rigid = plus({}, angular, spin_);
  return plus(rigid, 1 / scale_, plus(unscaled, -1, rigid));
}

Matrix2 StrainMass::turned(const Matrix2& rate, double time) const {
  // V = σ F + V'; both parts of the plane of V' are turned into each other, and neither has a share of F or W
  // F.
  const double angular = inner(spin_, rate) / inertia_, swelling = inner(shape_, rate) / inertia_;
  const Matrix2 rest = plus(plus(rate, -angular, spin_), -swelling, shape_);
  const double angle = (1 - 1 / scale_) * angular * time,
               squared = angle * angle;  // half of what V' turns by
  const double cosine = (1 - squared) / (1 + squared), sine = 2 * angle / (1 + squared);
  const Matrix2 carried = plus(plus({}, angular, spin_), swelling - angle * angular, shape_);
  return plus(plus(carried, cosine, rest), sine, spun(rest));
}

}  // namespace talus
