#include "conformance/check.hpp"
#include "conformance/contact_calls.hpp"
#include "conformance/contact_energy.hpp"
#include "conformance/contact_forces.hpp"

namespace talus::conformance {

std::span<const Check> contact_checks() {
  static constexpr Check checks[] = {
      {"parameters", "declared defaults make a law; other values make one or are refused in words",
       check_parameters},
      {"balance", "all loads of a pair are in balance: ΣF = 0, ΣM = 0", check_balance},
      {"translation", "a place elsewhere changes no force", check_translation},
      {"rotation", "forces turn with the bodies", check_rotation},
      {"reflection", "a mirror image gives the mirror image of the forces", check_reflection},
      {"order", "which body comes first does not matter", check_order},
      {"galilean", "a velocity that both bodies share changes no force", check_galilean},
      {"gap", "bodies apart bear no load, and are as far apart as the law says", check_gap},
      {"tension", "bodies do not pull at each other", check_tension},
      {"interfaces", "a pair has the parameters of its own interface", check_interfaces},
      {"friction", "|T| <= μ P, and no less where bodies slide", check_friction_limit},
      {"settling", "without friction and bonds a scene that settles has the same forces", check_settling},
      {"reports", "reports say what the loads are, and how deep bodies are in each other", check_reports},
      {"potential", "force = -∂Π/∂q in every coordinate of both bodies", check_potential},
      {"account", "what is put in is stored or booked as lost", check_account},
      {"cycles", "closed paths give no energy", check_cycles},
      {"joint", "passing a joint between collinear edges makes no kick", check_joint},
      {"strips", "bodies of many elements are met as whole ones are, and loads are in balance", check_strips},
      {"stiffness", "stiffness() bounds what is measured, and is of its order", check_stiffness},
      {"restore", "the same history gives the same bits: all state lives with the host", check_restore},
      {"reset", "a contact that is new starts afresh", check_reset},
      {"split", "the same bits in any split of a batch, in any thread", check_split},
      {"plan", "the same bits with a plan of the batch as without", check_plan},
      {"writes", "writes only where it may", check_writes},
      {"reads", "reads nothing past its arrays", check_reads},
      {"degenerate", "degenerate bodies give finite loads; what is no number comes to an end",
       check_degenerate},
      {"cost", "what a contact costs", measure_cost}};
  return checks;
}

}  // namespace talus::conformance
