#include "verification/rectangle_mesh.hpp"

#include <fmt/format.h>

#include <cmath>

namespace talus::verification {

std::string RectangleMesh::text() const {
  const auto node = [&](int i, int j) { return 1 + i + j * (columns + 1); };
  std::string nodes;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      const double along = size.x * i / columns, up = size.y * j / rows;
      nodes +=
          fmt::format("{} {} {} 0\n", node(i, j), corner.x + along * std::cos(angle) - up * std::sin(angle),
                      corner.y + along * std::sin(angle) + up * std::cos(angle));
    }
  }
  std::string elements;
  int count = 0;
  const auto line = [&](int group, int from, int to) {
    elements += fmt::format("{} 1 2 {} {} {} {}\n", ++count, group, group, from, to);
  };
  const auto triangle = [&](int a, int b, int c) {
    elements += fmt::format("{} 2 2 5 5 {} {} {}\n", ++count, a, b, c);
  };
  for (int j = 0; j < rows; ++j) {
    line(1, node(0, j + 1), node(0, j));
    line(2, node(columns, j), node(columns, j + 1));
  }
  for (int i = 0; i < columns; ++i) {
    line(3, node(i + 1, rows), node(i, rows));
    line(4, node(i, 0), node(i + 1, 0));
  }
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const int a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1), d = node(i, j + 1);
      const bool even = (i + j) % 2 == 0;
      triangle(a, b, even ? c : d);
      triangle(even ? a : b, c, d);
    }
  }
  return fmt::format(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
      "$PhysicalNames\n5\n1 1 \"left\"\n1 2 \"right\"\n1 3 \"top\"\n1 4 \"bottom\"\n2 5 \"body\"\n"
      "$EndPhysicalNames\n$Nodes\n{}\n{}$EndNodes\n$Elements\n{}\n{}$EndElements\n",
      node(columns, rows), nodes, count, elements);
}

}  // namespace talus::verification
