#include "heerk_rotor/models/blade_polars.hpp"

#include <filesystem>
#include <fstream>

#include "heerk_rotor/aero/c81_writer.hpp"
#include "models/blade_airloads_rig.hpp"

namespace heerk_rotor {
namespace {

using namespace test;

constexpr double kRad = M_PI / 180.0;

/// cl = slope alpha, cd = cd0 + alpha^2 / 2, cm = -0.01 + slope alpha / 100 up to 40 deg and for all Mach numbers, on a grid of one degree.
C81Deck deckOf(const std::string& name, double slope, double cd0) {
  C81Deck deck;
  deck.name = name;
  C81Block block;
  block.mach = {0.0, 0.9};
  for (int i = -40; i <= 40; ++i) block.alpha_deg.push_back(i);
  deck.lift = deck.drag = deck.moment = block;
  for (int i = -40; i <= 40; ++i)
    for (int m = 0; m < 2; ++m) {
      const double alpha = i * kRad;
      deck.lift.values.push_back(slope * alpha);
      deck.drag.values.push_back(cd0 + 0.5 * alpha * alpha);
      deck.moment.values.push_back(-0.01 + 0.01 * slope * alpha);
    }
  return deck;
}

/// A directory with decks a.c81 (slope 5), b.c81 (slope 6.5) and broken.c81, beside which configurations lie.
class BladePolarsTest : public testing::Test {
 protected:
  BladePolarsTest() {
    char pattern[] = "/tmp/heerk_polarsXXXXXX";
    directory_ = std::string(mkdtemp(pattern)) + "/";
    std::filesystem::create_directory(directory_ + "airfoils");
    write("airfoils/a.c81", deckOf("A", 5.0, 0.01));
    write("airfoils/b.c81", deckOf("B", 6.5, 0.02));
    std::ofstream(directory_ + "broken.c81") << "no deck\nat all\n";
  }
  ~BladePolarsTest() override { std::filesystem::remove_all(directory_); }
  void write(const std::string& name, const C81Deck& deck) {
    std::ofstream out(directory_ + name);
    writeC81(out, deck);
  }
  AirloadsRig rig(const std::string& keys, int sections = 4) { return {rotorOf(3, sections), keys, directory_}; }
  std::string complaintsAbout(const std::string& keys) { return rig(keys).complaints; }

  std::string directory_;
};

TEST_F(BladePolarsTest, aTableOfTheLinearPolarGivesItsLoads) {
  for (const std::string interpolation : {"linear", "monotone_cubic"}) {
    AirloadsRig table = rig("    polar: table\n    airfoil: airfoils/a.c81\n    interpolation: " + interpolation + "\n");
    AirloadsRig formula = rig("    lift_slope: 5.0\n    drag: [0.01, 0.0, 0.5]\n    compressible: false\n");
    ASSERT_EQ(table.complaints + formula.complaints, "");
    for (AirloadsRig* r : {&table, &formula}) r->turn(kOmega, 0.1);
    for (AirloadsRig* r : {&table, &formula}) r->port("inflow")[0] = 0.03;
    const Vector a = table.output("section_loads"), b = formula.output("section_loads"), mach = table.output("mach");
    for (Index j = 0; j < 4; ++j) {
      const double speed = mach[sectionEntry(j, 0, 1, 0, 3)] * 340.3;
      const double q = 0.5 * 1.225 * speed * speed * 0.27 * table.sections.width[j];
      // Decks hold five decimals; between whole degrees a parabola is within 0.5 (1 deg)^2 / 8 = 2e-5 of its chord.
      EXPECT_LT((table.loadOf(a, j, 1) - formula.loadOf(b, j, 1)).head(3).norm(), 4e-5 * q) << interpolation;
      const double alpha = table.output("angle_of_attack")[sectionEntry(j, 0, 1, 1, 3)];
      EXPECT_NEAR(table.loadOf(a, j, 1)[3], q * 0.27 * (-0.01 + 0.05 * alpha), 1e-5 * q) << interpolation;
    }
  }
}

TEST_F(BladePolarsTest, betweenStationsTheAirfoilsAreBlendedLinearlyInRadius) {
  AirloadsRig blended = rig("    polar: table\n    airfoil: [airfoils/a.c81, airfoils/b.c81]\n    airfoil_stations: [0.4, 0.8]\n", 8);
  ASSERT_EQ(blended.complaints, "");
  blended.turn(kOmega, 4.0 * kRad);  // a grid point of the decks
  const Vector loads = blended.output("section_loads");
  for (Index j = 0; j < 8; ++j) {
    const double r = blended.sections.r[j] / blended.sections.radius, share = std::clamp((r - 0.4) / 0.4, 0.0, 1.0);
    const double speed = kOmega * blended.sections.r[j], q = 0.5 * 1.225 * speed * speed * 0.27 * blended.sections.width[j];
    EXPECT_NEAR(blended.loadOf(loads, j, 2)[2], q * (5.0 + 1.5 * share) * 4.0 * kRad, 1e-5 * q) << r;
    EXPECT_NEAR(-blended.loadOf(loads, j, 2)[1], q * (0.01 + 0.01 * share + 0.5 * std::pow(4.0 * kRad, 2)), 1e-5 * q) << r;
  }
}

TEST_F(BladePolarsTest, sectionsOfOneAirfoilShareOneTable) {
  const std::vector<C81Deck> decks{deckOf("A", 5.0, 0.01), deckOf("B", 6.0, 0.01)};
  const BladePolars polars = blendedPolars(decks, {0.4, 0.8}, {0.1, 0.3, 0.4, 0.5, 0.6, 0.8, 0.9}, TableInterpolation::kLinear);
  EXPECT_EQ(polars.tables.size(), 4u);
  EXPECT_EQ(polars.table_of_section, (std::vector<std::size_t>{0, 0, 0, 1, 2, 3, 3}));
}

TEST_F(BladePolarsTest, absolutePathsStayAbsoluteAndUnusedDecksAreNotOpened) {
  EXPECT_EQ(complaintsAbout("    polar: table\n    airfoil: " + directory_ + "airfoils/a.c81\n"), "");
  EXPECT_EQ(complaintsAbout("    polar: linear\n    airfoil: nowhere.c81\n    interpolation: linear\n"), "");
}

TEST_F(BladePolarsTest, badDecksAndListsAreToldWithTheirPlace) {
  const auto expectParts = [&](const std::string& keys, const std::vector<std::string>& parts) {
    const std::string text = complaintsAbout(keys);
    for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << "\nnot in\n" << text;
  };
  expectParts("    polar: table\n    airfoil: broken.c81\n", {directory_ + "rig.yaml:7: subsystems.airloads.airfoil = broken.c81: expected an airfoil in the C81 format, but " + directory_ + "broken.c81:"});
  expectParts("    polar: table\n    airfoil: [airfoils/a.c81, nowhere.c81]\n    airfoil_stations: [0.2, 0.9]\n", {"rig.yaml:7", directory_ + "nowhere.c81"});
  expectParts("    polar: table\n", {"subsystems.airloads.airfoil = (missing): expected the path of a C81 deck"});
  expectParts("    polar: table\n    airfoil: [airfoils/a.c81, airfoils/b.c81]\n", {"airfoil_stations = (missing): expected a list of 2 ascending numbers"});
  expectParts("    polar: table\n    airfoil: [airfoils/a.c81, airfoils/b.c81]\n    airfoil_stations: [0.9, 0.2]\n", {"rig.yaml:8: subsystems.airloads.airfoil_stations"});
  expectParts("    polar: table\n    airfoil: {a: 1}\n", {"expected a word, or a list of words"});
  expectParts("    polar: tabel\n", {"rig.yaml:6: subsystems.airloads.polar = tabel: expected one of linear, table (did you mean 'table'?)"});
  expectParts("    drag: [0.01, 0, 1, 2]\n", {"at most three coefficients"});
  expectParts("    chord: [0.3, 0.2]\n    chord_stations: [0.1, 0.5, 1.0]\n", {"rig.yaml:7: subsystems.airloads.chord_stations", "a list of 2 ascending numbers"});
  expectParts("    chord: -0.3\n    tip_loss_factor: 1.2\n    elastic_axis: 2\n    air_density: 0\n    speed_of_sound: fast\n    unsteady: theodorsen\n    kinematics: none\n    cord: 1\n",
              {"rig.yaml:6: subsystems.airloads.chord = -0.3: expected a number > 0 [m]", "rig.yaml:7: subsystems.airloads.tip_loss_factor = 1.2: expected a number in [0.5, 1] [r/R]",
               "rig.yaml:8: subsystems.airloads.elastic_axis = 2", "rig.yaml:9: subsystems.airloads.air_density = 0", "rig.yaml:10: subsystems.airloads.speed_of_sound = fast",
               "rig.yaml:11: subsystems.airloads.unsteady = theodorsen: expected one of none, wagner, beddoes", "rig.yaml:12: subsystems.airloads.kinematics = none",
               "rig.yaml:13: subsystems.airloads.cord = 1: expected a known key (did you mean 'chord'?)"});
  expectParts("    rotor: nothing\n", {"subsystems.airloads.rotor = nothing: expected the name of the fe_rotor"});
}

}  // namespace
}  // namespace heerk_rotor
