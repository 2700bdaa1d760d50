// Measured hover rotors (docs/validation.md) against the shipped configurations as they are.
#include <fstream>
#include <sstream>

#include "models/rotor_runs.hpp"

namespace heerk_rotor {
namespace {

using namespace test;

/// Rows of numbers below the headings of a data file; an empty field is NaN.
std::vector<std::vector<double>> measured(const std::string& name) {
  std::ifstream file(std::string(HEERK_SOURCE_DIR) + "/docs/validation/" + name);
  EXPECT_TRUE(file) << name;
  std::vector<std::vector<double>> rows;
  bool headings = true;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    if (!headings) {
      rows.emplace_back();
      std::istringstream fields(line + ",");
      for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(field.empty() ? std::nan("") : std::stod(field));
    }
    headings = false;
  }
  return rows;
}

/// Steady hover: CT, CT/sigma, figure of merit. A run is over when they change by less than 1e-5 in one revolution (the last transient is that of
/// the inflow, which has then 1e-4 to go at most).
Vector hover(const std::string& configuration, double collective, const Overrides& more = {}) {
  auto simulation = buildSimulation(shipped(configuration, Overrides{set("subsystems.swashplate.trim_collective", collective)} + more));
  Recorder record(*simulation, {"coefficients.thrust_coefficient", "coefficients.blade_loading", "coefficients.figure_of_merit"}, 180);
  for (int revolution = 0; revolution < 60; ++revolution) {
    EXPECT_TRUE(advance(*simulation, 180));
    const std::size_t n = record.rows.size();
    if (n > 5 && ((record.rows[n - 1] - record.rows[n - 2]).array() / record.rows[n - 1].array()).abs().maxCoeff() < 1e-5) return record.rows.back();
  }
  ADD_FAILURE() << configuration << " does not become steady at " << collective << " rad";
  return record.rows.back();
}

TEST(HoverValidation, bothConfigurationsShareTheirChoices) {
  // What is not known from the tests must be the same in both: nothing is adjusted to one of them.
  const Configuration a = shipped("castles_gray.yaml"), b = shipped("harrington.yaml");
  for (const char* key : {"polar", "lift_slope", "drag", "tip_loss_factor", "speed_of_sound"}) {
    const auto entry = [&](const Configuration& c) { std::ostringstream text; text << c.root()["subsystems"]["airloads"][key]; return text.str(); };
    EXPECT_EQ(entry(a), entry(b)) << key;
  }
  EXPECT_EQ(a.root()["subsystems"]["airloads"]["lift_slope"].as<double>(), 5.73);
  EXPECT_EQ(a.root()["subsystems"]["airloads"]["tip_loss_factor"].as<double>(), 0.97);
  for (const Configuration* c : {&a, &b}) EXPECT_EQ(c->root()["subsystems"]["inflow"]["induced_power_factor"].as<double>(), 1.0);
}

TEST(HoverValidation, thrustOfCastlesAndGraysRotor) {
  const auto rows = measured("castles_gray_1951_tn2474_hover.csv");  // run, CT, rpm, pitch [deg], CQ difference
  ASSERT_EQ(rows.size(), 11u);
  double squares = 0.0;
  for (const auto& row : rows) {
    const Vector now = hover("castles_gray.yaml", row[3] * M_PI / 180.0, {set("simulation.rotor_speed", row[2] * M_PI / 30.0)});
    squares += std::pow(now[0] / row[1] - 1.0, 2);
  }
  const double rms = std::sqrt(squares / static_cast<double>(rows.size()));
  report("rms error of CT", rms);
  EXPECT_LE(rms, 0.08);  // the bar for methods of this class; equal pitch gave CT within 5 % in the test itself
}

TEST(HoverValidation, figureOfMeritOfHarringtonsRotor) {
  std::vector<double> loading, merit;
  for (double collective = 4.0; collective <= 12.1; collective += 1.0) {
    const Vector now = hover("harrington.yaml", collective * M_PI / 180.0);
    loading.push_back(now[1]);
    merit.push_back(now[2]);
  }
  int compared = 0;
  double worst = 0.0;
  for (const auto& row : measured("harrington_1951_tn2318_rotor1_single.csv")) {  // CT/sigma, figure of merit
    if (row[0] < 0.04 || row[0] > 0.12) continue;
    const auto after = static_cast<std::size_t>(std::upper_bound(loading.begin(), loading.end(), row[0]) - loading.begin());
    ASSERT_GT(after, 0u);
    ASSERT_LT(after, loading.size()) << row[0];
    const double share = (row[0] - loading[after - 1]) / (loading[after] - loading[after - 1]);
    worst = std::max(worst, std::abs((1.0 - share) * merit[after - 1] + share * merit[after] - row[1]));
    ++compared;
  }
  EXPECT_EQ(compared, 5);
  report("largest error of the figure of merit", worst);
  EXPECT_LE(worst, 0.05);  // the bar for methods of this class; the figure was read to 0.01
}

}  // namespace
}  // namespace heerk_rotor
