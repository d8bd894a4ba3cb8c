#pragma once

namespace talus {

struct Vec2 {
  double x = 0, y = 0;
};

}  // namespace talus
