// Cost of one step of the dual-disc rotor by each method of the comparison (docs/paper_dual_disc), through the general coupled system and without observers.
#include "step_benchmark.hpp"

namespace heerk_rotor {
namespace {

/// Physical coordinates are the paper's; modal ones are the default.
std::vector<std::string> with(const std::string& method, const std::string& step, const std::string& coordinates = "modal", const std::string& rpm = "5000") {
  return {"simulation.integrator=" + method, "simulation.step=" + step, "subsystems.shaft.coordinates=" + coordinates, "simulation.rotor_speed_rpm=" + rpm};
}

BENCHMARK_CAPTURE(step, HEERK4, "dual_disc.yaml", with("HEERK4", "1e-5"));
BENCHMARK_CAPTURE(step, HEERK4_40000rpm, "dual_disc.yaml", with("HEERK4", "1e-5", "modal", "40000"));
BENCHMARK_CAPTURE(step, HEERK3, "dual_disc.yaml", with("HEERK3", "5e-6"));
BENCHMARK_CAPTURE(step, Newmark, "dual_disc.yaml", with("Newmark", "5e-6"));
BENCHMARK_CAPTURE(step, Newmark_physical, "dual_disc.yaml", with("Newmark", "1e-6", "physical"));
BENCHMARK_CAPTURE(step, precise_1_physical, "dual_disc.yaml", with("precise_1", "1e-6", "physical"));
BENCHMARK_CAPTURE(step, precise_2_physical, "dual_disc.yaml", with("precise_2", "1e-6", "physical"));
BENCHMARK_CAPTURE(step, precise_2_modal, "dual_disc.yaml", with("precise_2", "1e-6"));

}  // namespace
}  // namespace heerk_rotor
