#include "blocks/generator.hpp"

#include "geometry/outlines.hpp"
#include "scene/sample.hpp"

namespace talus {

std::string generator_scene(const std::string& rest, const std::string& domain) {
  return R"({"talus": 1, "materials": {"rock": {"density": 2300, "model": "linear_elastic", "young_modulus": 1e10}},
"contact": {"model": "smooth"}, "interfaces": [{"between": ["*", "*"], "normal_stiffness": 1e10}],
"blocks": [{"name": "b", "domain": )" +
         domain + R"(, "material": "rock")" + (rest.empty() ? "" : ", " + rest) + R"(}],
"time": {"end": 1}})";
}

std::vector<SceneBody> made(const std::string& rest, const std::string& domain) {
  return sample::read(generator_scene(rest, domain)).bodies;
}

double area_of(const SceneBody& body) {
  double area = signed_area(body.outer.vertices);
  for (const Loop& hole : body.holes) area += signed_area(hole.vertices);
  return area;
}

double area_sum(const std::vector<SceneBody>& bodies) {
  double sum = 0;
  for (const SceneBody& body : bodies) sum += area_of(body);
  return sum;
}

}  // namespace talus
