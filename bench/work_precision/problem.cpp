#include "problem.hpp"

#include <stdexcept>

#include "heerk_rotor/assembly/build_simulation.hpp"
#include "heerk_rotor/config/configuration.hpp"

namespace heerk_rotor::work_precision {
namespace {

CoupledSystem systemOf(const std::string& file, Problem::Overrides overrides, const Problem::Overrides& more) {
  overrides.insert(overrides.end(), more.begin(), more.end());
  return buildSystem(Configuration::load(std::string(HEERK_SOURCE_DIR) + "/config/" + file, overrides));
}

/// The paper's Section 3 with blade states in which all mast stiffness is inside S.
Problem lagRotor(const std::string& stiffness) {
  Problem problem;
  problem.name = "lag_rotor_" + stiffness;
  problem.group = "lag_rotor";
  problem.meaning = "lag rotor on an elastic mast, K_s = " + stiffness + " N m/rad, absolute-lag form, 10 s; lag angles";
  problem.build = [stiffness](const Problem::Overrides& more) { return systemOf("lag_rotor.yaml", {"subsystems.mast.stiffness=" + stiffness}, more); };
  problem.newton_tolerance = 1e-12;
  problem.duration = 10.0;
  problem.instants = 50;
  problem.measured = {"rotor.lag"};
  // omega of the twist is 102, 1020, 10199 rad/s; S holds it exactly, what is left asks for steps of a tenth of a blade's motion per omega.
  problem.fine_step = 2e-5;
  if (stiffness == "3e8") problem.patience = 8.0;  // to resolve 16 000 periods of the twist takes anyone a second
  return problem;
}

Problem dualDisc(const std::string& rpm) {
  Problem problem;
  problem.name = "dual_disc_" + rpm;
  problem.group = "dual_disc";
  problem.meaning = "dual-disc rotor with squeeze film from rest, " + rpm + " rpm, 0.1 s; displacements of the discs after 0.08 s";
  problem.build = [rpm](const Problem::Overrides& more) { return systemOf("dual_disc.yaml", {"simulation.rotor_speed_rpm=" + rpm}, more); };
  problem.duration = 0.1;
  problem.instants = 50;  // no more, because methods without dense output step from instant to instant
  problem.first_instant = 40;
  problem.measured = {"shaft.displacement"};
  problem.second_order = {"subsystems.shaft.coordinates=physical"};
  problem.newmark = {"subsystems.shaft.unbalance_in_exponential=false"};
  problem.fine_step = 1e-6;
  return problem;
}

}  // namespace

Vector Problem::startOf(const CoupledSystem& system) const {
  Vector x = system.initialState();
  const std::vector<std::string> names = system.stateNames();
  for (Index i = 0; i < x.size(); ++i)
    if (const auto found = start.find(names[static_cast<std::size_t>(i)]); found != start.end()) x[i] = found->second;
  return x;
}

std::vector<std::string> problemNames() {
  return {"lag_rotor_3e4", "lag_rotor_3e6", "lag_rotor_3e8", "blades_1", "blades_4", "rotor", "dual_disc_5000", "dual_disc_40000"};
}

Problem makeProblem(const std::string& name) {
  for (const char* stiffness : {"3e4", "3e6", "3e8"})
    if (name == std::string("lag_rotor_") + stiffness) return lagRotor(stiffness);
  for (const char* rpm : {"5000", "40000"})
    if (name == std::string("dual_disc_") + rpm) return dualDisc(rpm);
  if (name == "blades_1") return bladesOnHub(1);
  if (name == "blades_4") return bladesOnHub(4);
  if (name == "rotor") return completeRotor();
  std::string known;
  for (const std::string& other : problemNames()) known += " " + other;
  throw std::invalid_argument("problem '" + name + "': unknown, expected one of" + known);
}

}  // namespace heerk_rotor::work_precision
