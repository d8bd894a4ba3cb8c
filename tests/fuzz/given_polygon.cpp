#include "given_polygon.hpp"

#include <algorithm>
#include <cmath>

namespace talus::fuzz {

int GivenPolygons::byte() {
  if (bytes_.empty()) return 0;
  const auto taken = static_cast<unsigned char>(bytes_.front());
  bytes_.remove_prefix(1);
  return taken;
}

double GivenPolygons::anywhere() {
  const int high = byte(), middle = byte(), low = byte();
  return (high * 65536 + middle * 256 + low) * (20.0 / 16777216) - 10;
}

Vec2 GivenPolygons::corner() {
  const int kind = byte();
  const auto known = [&] { return all_[static_cast<std::size_t>(byte()) % all_.size()]; };
  switch (all_.empty() ? 0 : kind % 6) {
    case 1: {  // of another, or within rounding of it
      const Vec2 at = known();
      const double off = std::ldexp(1, -40 - kind / 6 % 20) * (byte() - 128);
      return {at.x + off, at.y};
    }
    case 2: {  // on the line through two of them
      const Vec2 from = known(), to = known();
      const double share = byte() / 128.0;
      return {from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)};
    }
    case 3: {
      const double x = anywhere(), y = anywhere();
      return {x, y};
    }
    case 4: {  // near the last one
      const Vec2 at = all_.back();
      const double step = std::ldexp(1, -(kind / 6 % 32));
      const double x = step * (byte() - 128), y = step * (byte() - 128);
      return {at.x + x, at.y + y};
    }
    default: {
      const double x = on_grid() / 4, y = on_grid() / 4;
      return {x, y};
    }
  }
}

Ring GivenPolygons::next() {
  Ring ring;
  const int count = 3 + byte() % 8;
  for (int i = 0; i < count; ++i) {
    ring.push_back(corner());
    all_.push_back(ring.back());
  }
  if (signed_area(ring) < 0) std::reverse(ring.begin(), ring.end());
  return ring;
}

}  // namespace talus::fuzz
