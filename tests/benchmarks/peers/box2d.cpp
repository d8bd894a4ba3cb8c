// Steps rigid bodies with Box2D and prints what a step cost and what became of the bodies, as JSON.
//
//   peer_box2d BODIES STEPS DT FRICTION
//
// BODIES is a text: per body its velocity, how many vertices it has, and these, counter-clockwise; "fixed"
// stands for the velocity of a body that does not move. compare.py writes it.

#include <box2d/box2d.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

// What the manual of Box2D suggests.
constexpr int velocity_iterations = 8, position_iterations = 3;
constexpr float density = 2300, gravity = 9.81F;
constexpr int warm_up = 10;  ///< steps that are not timed: the first ones find all pairs

double process_time() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

b2Body* add_body(b2World& world, std::ifstream& file, const std::string& first, float friction) {
  b2BodyDef definition;
  definition.type = first == "fixed" ? b2_staticBody : b2_dynamicBody;
  definition.allowSleep = false;
  if (first != "fixed") {
    definition.linearVelocity.x = std::stof(first);
    file >> definition.linearVelocity.y;
  }
  std::size_t count = 0;
  file >> count;
  std::vector<b2Vec2> vertices(count);
  for (b2Vec2& vertex : vertices) file >> vertex.x >> vertex.y;
  if (!file || count < 3 || count > b2_maxPolygonVertices) throw std::runtime_error("a body is incomplete");
  // Positions of vertices are kept relative to the body, which keeps the digits of a float.
  definition.position = vertices[0];
  for (b2Vec2& vertex : vertices) vertex -= definition.position;
  b2PolygonShape shape;
  shape.Set(vertices.data(), static_cast<int32>(count));
  b2FixtureDef fixture;
  fixture.shape = &shape;
  fixture.density = density;
  fixture.friction = friction;
  b2Body* body = world.CreateBody(&definition);
  body->CreateFixture(&fixture);
  return body;
}

int touching_contacts(const b2World& world) {
  int touching = 0;
  for (const b2Contact* contact = world.GetContactList(); contact != nullptr; contact = contact->GetNext())
    touching += contact->IsTouching() ? 1 : 0;
  return touching;
}

int run(const char* path, int steps, float dt, float friction) {
  b2World world({0, -gravity});
  world.SetAllowSleeping(false);
  std::ifstream file(path);
  std::vector<b2Body*> moving;
  for (std::string first; file >> first;) {
    b2Body* body = add_body(world, file, first, friction);
    if (body->GetType() == b2_dynamicBody) moving.push_back(body);
  }
  if (moving.empty()) throw std::runtime_error("no body that moves");
  for (int i = 0; i < warm_up; ++i) world.Step(dt, velocity_iterations, position_iterations);
  const double before = process_time();
  for (int i = warm_up; i < steps; ++i) world.Step(dt, velocity_iterations, position_iterations);
  const double seconds = process_time() - before;
  double energy = 0, mass = 0, largest = 0;
  int awake = 0;
  for (const b2Body* body : moving) {
    const double own = body->GetLinearVelocity().Length();
    energy += own * own * body->GetMass() / 2;
    mass += body->GetMass();
    largest = std::fmax(largest, own);
    awake += body->IsAwake() ? 1 : 0;
  }
  std::printf(
      R"({"ns": %.6g, "speed": %.6g, "largest_speed": %.6g, "awake": %d, "touching": %d, "pairs": %d})"
      "\n",
      seconds * 1e9 / static_cast<double>(steps - warm_up) / static_cast<double>(moving.size()),
      std::sqrt(2 * energy / mass), largest, awake, touching_contacts(world), world.GetContactCount());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5 || std::atoi(argv[2]) <= warm_up) {
    std::fprintf(stderr, "usage: peer_box2d BODIES STEPS DT FRICTION, with more than %d steps\n", warm_up);
    return 2;
  }
  try {
    return run(argv[1], std::atoi(argv[2]), std::strtof(argv[3], nullptr), std::strtof(argv[4], nullptr));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "peer_box2d: %s\n", error.what());
    return 2;
  }
}
