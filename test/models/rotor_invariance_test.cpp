// What must not matter: which blade is number 1, where north is, the side of a mirror, and where in the azimuth an axisymmetric rotor begins.
// The complete Bo105 with fuselage on springs, elastic mast, tables and dynamic inflow runs twice, and the two must tell the same story.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "heerk_rotor/analysis/trim.hpp"
#include "models/rotor_runs.hpp"

namespace heerk_rotor {
namespace {

using namespace test;
using Eigen::Vector3d;

constexpr double kDegree = M_PI / 180;

std::vector<std::string> axes(const std::string& prefix) { return {prefix + "_x", prefix + "_y", prefix + "_z"}; }
std::string triple(const Vector3d& v) {
  char text[128];
  std::snprintf(text, sizeof text, "[%.17g, %.17g, %.17g]", v[0], v[1], v[2]);
  return text;
}

const Overrides kControls{"subsystems.swashplate.trim_collective=0.14", "subsystems.swashplate.trim_lateral_cyclic=0.02",
    "subsystems.swashplate.trim_longitudinal_cyclic=-0.04",
                          "simulation.newton_tolerance=1e-13"};
const Overrides kWind{"subsystems.fuselage.wind=[-35.0, 8.0, 2.0]"};

/// States that differ from blade to blade, of a size that the mode's stiffness allows.
void disturbBlades(const CoupledSystem& system, int blades, int first, Vector& x) {
  const CoupledSystem::Subsystem& rotor = subsystem(system, "rotor");
  const ModalStiff& modal = std::get<ModalStiff>(rotor.stiff);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (Index part = 0; part < 2; ++part) {
    for (Index mode = 0; mode < rotor.x_size / (2 * blades); ++mode) {
      const double ratio = 33.0 / std::max(33.0, modal.omega[mode * blades]);
      for (int k = 0; k < blades; ++k) {
        const int label = (k + blades - first) % blades;  // blade k of the original is blade k - first here
        x[rotor.x_begin + (part * rotor.x_size / (2 * blades) + mode) * blades + label] = (part == 0 ? 0.4 : 10.0) * ratio * ratio * unit(random);
      }
    }
  }
}

/// Largest difference of two columns of the record, over its largest entry.
double difference(const Recorder& a, const Recorder& b, Index i, Index j, double sign = 1.0) {
  double apart = 0.0, size = 0.0;
  for (std::size_t n = 0; n < a.rows.size(); ++n) {
    apart = std::max(apart, std::abs(a.rows[n][i] - sign * b.rows[n][j]));
    size = std::max(size, std::abs(a.rows[n][i]));
  }
  EXPECT_GT(size, 0.0);
  return apart / size;
}

TEST(RotorInvariance, numberingOfBlades) {
  const std::vector<std::vector<double>> factors{{1.0, 1.0, 1.0, 1.0}, {1.0, 1.05, 0.97, 1.02}};
  for (const std::vector<double>& factor : factors) {
    for (const int first : {1, 2}) {
      const int blades = 4;
      std::string lists[2];
      for (int k = 0; k < blades; ++k) {
        lists[0] += (k ? ", " : "[") + std::to_string(factor[static_cast<std::size_t>(k)]);
        lists[1] += (k ? ", " : "[") + std::to_string(factor[static_cast<std::size_t>((k + first) % blades)]);
      }
      std::unique_ptr<Simulation> runs[2];
      std::unique_ptr<Recorder> records[2];
      std::vector<std::string> names = axes("fuselage.hub_force") + axes("fuselage.hub_moment") + axes("fuselage.position") + axes("fuselage.rate") +
                                       Overrides{"mast.twist", "inflow.inflow_mean", "inflow.inflow_sine", "inflow.inflow_cosine"};
      const Index common = static_cast<Index>(names.size());
      for (const char* port : {"rotor.flap_", "rotor.lag_", "rotor.tip_twist_"})
        for (int k = 1; k <= blades; ++k) names.push_back(port + std::to_string(k));
      for (int i = 0; i < 2; ++i) {
        runs[i] = buildSimulation(shipped("bo105.yaml", kControls + kWind + Overrides{"subsystems.rotor.mass_factor=" + lists[i] + "]",
            "subsystems.rotor.stiffness_factor=" + lists[i] + "]",
                                                                                     set("subsystems.drive.initial.angle",
                                                                                         i * first * 2 * M_PI / blades)}));
        Vector x = runs[i]->state();
        disturbBlades(runs[i]->system(), blades, i * first, x);
        runs[i]->setState(x);
        records[i] = std::make_unique<Recorder>(*runs[i], names);
        ASSERT_TRUE(advance(*runs[i], 360)) << runs[i]->failure().cause;
      }
      double worst = 0.0;
      for (Index i = 0; i < common; ++i) worst = std::max(worst, difference(*records[0], *records[1], i, i));
      for (Index port = 0; port < 3; ++port)
        for (int k = 0; k < blades; ++k)
          worst = std::max(worst, difference(*records[0], *records[1], common + port * blades + (k + first) % blades, common + port * blades + k));
      report("blade 1 is blade " + std::to_string(first + 1) + (factor[1] == 1.0 ? ", equal blades" : ", unequal blades"), worst);
      EXPECT_LE(worst, 1e-10);  // required; round-off 1e-16 of the azimuth and of forces ten times the thrust, over 360 steps
    }
  }
}

TEST(RotorInvariance, headingOfFuselageAndWind) {
  for (const char* mode : {"spring6", "free"}) {
    const double heading = 70.0;
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(heading * kDegree, Vector3d::UnitZ()).toRotationMatrix();
    const Vector3d wind(-30.0, 7.0, 2.0);
    const std::vector<std::string> names = axes("fuselage.hub_force") + axes("fuselage.hub_moment") + axes("fuselage.velocity") +
        axes("fuselage.rate") +
                                           Overrides{"rotor.flap_1", "rotor.lag_2", "rotor.tip_twist_3", "mast.twist", "inflow.inflow_mean"} +
                                               axes("fuselage.position");
    std::unique_ptr<Simulation> runs[2];
    std::unique_ptr<Recorder> records[2];
    for (int i = 0; i < 2; ++i) {
      const Vector3d turned = i == 0 ? wind : Vector3d(turn * wind);
      runs[i] = buildSimulation(shipped("bo105.yaml", kControls + Overrides{std::string("subsystems.fuselage.mode=") + mode,
          "subsystems.fuselage.wind=" + triple(turned),
                                                                           set("subsystems.fuselage.heading_deg", i * heading),
                                                                               "subsystems.fuselage.pitch_deg=4",
                                                                               "subsystems.fuselage.roll_deg=-3"}));
      records[i] = std::make_unique<Recorder>(*runs[i], names);
      ASSERT_TRUE(advance(*runs[i], 360)) << runs[i]->failure().cause;
    }
    const Index own = static_cast<Index>(names.size()) - 3;
    double worst = 0.0, apart = 0.0, size = 0.0;
    for (Index i = 0; i < own; ++i) worst = std::max(worst, difference(*records[0], *records[1], i, i));
    for (std::size_t n = 0; n < records[0]->rows.size(); ++n) {
      apart = std::max(apart, (turn * records[0]->rows[n].tail<3>() - records[1]->rows[n].tail<3>()).norm());
      size = std::max(size, records[0]->rows[n].tail<3>().norm());
    }
    report(std::string("heading, ") + mode, std::max(worst, apart / size));
    EXPECT_LE(worst, 1e-10);  // as above
    EXPECT_LE(apart, 1e-10 * size);
  }
}

TEST(RotorInvariance, mirroredSenseOfRotation) {
  const Vector3d polar(1.0, -1.0, 1.0), axial(-1.0, 1.0, -1.0);
  for (const char* mode : {"spring6", "free"}) {
    const Vector3d wind(-30.0, 7.0, 2.0), hub(0.1, 0.2, 1.5), products(40.0, 200.0, -60.0);  // Ixy, Ixz, Iyz
    const Vector3d force(500.0, 800.0, -300.0), moment(400.0, -700.0, 900.0);
    const std::vector<std::string> names = axes("fuselage.hub_force") + axes("fuselage.velocity") + axes("fuselage.position") +
        axes("fuselage.hub_moment") + axes("fuselage.rate") +
                                           Overrides{"rotor.flap_1", "rotor.lag_2", "rotor.tip_twist_3", "mast.twist", "mast.torque",
                                               "inflow.inflow_sine"};
    std::unique_ptr<Simulation> runs[2];
    std::unique_ptr<Recorder> records[2];
    for (int i = 0; i < 2; ++i) {
      const Vector3d of_polar = i == 0 ? Vector3d(1, 1, 1) : polar, of_axial = i == 0 ? Vector3d(1, 1, 1) : axial;
      runs[i] = buildSimulation(shipped(
          "bo105.yaml", kControls + Overrides{std::string("subsystems.fuselage.mode=") + mode, std::string("subsystems.fuselage.rotation=") +
              (i == 0 ? "ccw" : "cw"),
                                              "subsystems.fuselage.wind=" + triple(of_polar.cwiseProduct(wind)), "subsystems.fuselage.hub_offset=" +
                                                  triple(of_polar.cwiseProduct(hub)),
                                              "subsystems.fuselage.products_of_inertia=" + triple(Vector3d(of_polar[1], 1,
                                                  of_polar[1]).cwiseProduct(products)),
                                              "subsystems.fuselage.pitch_deg=4", set("subsystems.fuselage.roll_deg", -3 * of_axial[0]),
                                                  set("subsystems.fuselage.heading_deg", 20 * of_axial[2])}));
      Vector w = runs[i]->system().defaultCommand();
      const auto& commands = runs[i]->system().commandNames();
      const auto begin = [&](const std::string& name) { return std::find(commands.begin(), commands.end(), name) - commands.begin(); };
      w.segment<3>(begin("fuselage.external_force_x")) = of_polar.cwiseProduct(force);
      w.segment<3>(begin("fuselage.external_moment_x")) = of_axial.cwiseProduct(moment);
      records[i] = std::make_unique<Recorder>(*runs[i], names);
      ASSERT_TRUE(advance(*runs[i], 360, w)) << runs[i]->failure().cause;
    }
    double worst = 0.0;
    for (Index i = 0; i < static_cast<Index>(names.size()); ++i)
      worst = std::max(worst, difference(*records[0], *records[1], i, i, i < 9 ? polar[i % 3] : i < 15 ? axial[i % 3] : 1.0));
    report(std::string("mirror, ") + mode, worst);
    EXPECT_LE(worst, 1e-10);
  }
}

/// In hover the azimuth has no beginning: cyclic pitch a cos(psi) + b sin(psi) turned by an angle turns all loads by it.
Overrides turnedCyclic(int blades, double angle) {
  const double a = 0.03, b = -0.05, c = std::cos(angle), s = std::sin(angle);
  return {"subsystems.fuselage.mode=rigid", "subsystems.fuselage.shaft_tilt_forward_deg=0", "subsystems.rotor.blades=" + std::to_string(blades),
      "simulation.newton_tolerance=1e-13",
          "subsystems.swashplate.trim_collective=0.14", set("subsystems.swashplate.trim_lateral_cyclic", a * c - b * s),
              set("subsystems.swashplate.trim_longitudinal_cyclic", a * s + b * c)};
}

TEST(RotorInvariance, cyclicPitchTurnedByABladeSpacingTurnsTheLoadsAtEveryInstant) {
  const std::vector<std::string> names = axes("fuselage.hub_force") + axes("fuselage.hub_moment");
  for (const int blades : {3, 4}) {
    std::unique_ptr<Recorder> records[2];
    std::unique_ptr<Simulation> runs[2];
    const double angle = 2 * M_PI / blades;
    for (int i = 0; i < 2; ++i) {
      runs[i] = buildSimulation(shipped("bo105.yaml", turnedCyclic(blades, i * angle)));
      records[i] = std::make_unique<Recorder>(*runs[i], names);
      ASSERT_TRUE(advance(*runs[i], 360)) << runs[i]->failure().cause;
    }
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix();
    double apart = 0.0, size = 0.0, in_plane = 0.0;
    for (std::size_t n = 0; n < records[0]->rows.size(); ++n) {
      const Vector &a = records[0]->rows[n], &b = records[1]->rows[n];
      apart = std::max({apart, (turn * a.head<3>() - b.head<3>()).norm(), (turn * a.tail<3>() - b.tail<3>()).norm()});
      size = std::max(size, a.head<3>().norm());
      in_plane = std::max(in_plane, a.head<2>().norm());
    }
    report("cyclic turned by a blade spacing, " + std::to_string(blades) + " blades", apart / size);
    EXPECT_GT(in_plane, 0.01 * size);
    EXPECT_LE(apart, 1e-10 * size);
  }
}

TEST(RotorInvariance, cyclicPitchTurnedByAQuarterTurnsTheMeanLoadsOfThreeBlades) {
  Vector means[2];
  for (int i = 0; i < 2; ++i) {
    const Configuration configuration = shipped("bo105.yaml", turnedCyclic(3, i * M_PI / 2) + Overrides{"subsystems.rotor.modes=4",
        "subsystems.airloads.polar=linear"});
    const auto build = [&] { return buildSimulation(configuration); };
    auto simulation = build();
    TrimSettings settings;
    settings.tolerance = 1e-11;
    TrimOptions options;
    options.threads = 1;
    const TrimResult periodic = trim(build, 2 * M_PI / 44.4, settings, options);
    ASSERT_TRUE(periodic.trimmed()) << periodic.message;
    simulation->setState(periodic.x);
    Recorder record(*simulation, axes("fuselage.hub_force") + axes("fuselage.hub_moment"));
    ASSERT_TRUE(advance(*simulation, 360, periodic.w));
    means[i] = Vector::Zero(6);
    for (const Vector& row : record.rows) means[i] += row / static_cast<double>(record.rows.size());
  }
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitZ()).toRotationMatrix();
  const double force = (turn * means[0].head<3>() - means[1].head<3>()).norm() / means[0].head<3>().norm();
  const double moment = (turn * means[0].tail<3>() - means[1].tail<3>()).norm() / means[0].tail<3>().norm();
  report("mean force, cyclic turned by 90 deg", force);
  report("mean moment, cyclic turned by 90 deg", moment);
  EXPECT_GT(means[0].segment<2>(3).norm(), 100.0);
  EXPECT_LE(force, 1e-10);  // that of the periodicity
  EXPECT_LE(moment, 1e-10);
}

}  // namespace
}  // namespace heerk_rotor
