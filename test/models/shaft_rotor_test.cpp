#include "heerk_rotor/models/shaft_rotor.hpp"

#include <cmath>
#include <complex>
#include <random>

#include <Eigen/LU>

#include "heerk_rotor/shaft/diagonal_form.hpp"
#include "heerk_rotor/shaft/energy_coordinates.hpp"
#include "models/rotor_runs.hpp"
#include "shaft/dual_disc.hpp"

namespace heerk_rotor {
namespace {

using namespace test;
using Complex = std::complex<ShaftReal>;
using ComplexMatrix = Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic>;

constexpr double kPi = 3.14159265358979323846;

/// The dual-disc rotor with everything that could be forgotten: shear, bore, unequal bearings with dampers, unbalances out of phase, two journals.
ShaftRotorParameters everything() {
  ShaftRotorParameters p;
  p.rotor_speed = 5000.0 * kPi / 30.0;
  p.shaft = test::dualDisc();
  p.shaft.shear = true;
  p.shaft.inner_diameter = {0.01};
  p.shaft.stiffness_damping = 1e-6;
  p.shaft.bearings = {{1, 1e8, 3e7, 400.0, 200.0}, {7, 5.7e6, 9e6, 100.0, 300.0}};
  p.shaft.discs[0].unbalance_angle = 0.4;
  p.shaft.discs[1].unbalance_angle = -2.1;
  p.journals = {7, 4};
  p.linearised_film_damping = 700.0;
  return p;
}

/// (q, q') of the steady response to the unbalance of nominal speed at t, from the impedance of the second-order equation.
ShaftVector steadyMotion(const ShaftMatrices& shaft, double omega, double t) {
  const ShaftReal w = omega;
  const ComplexMatrix impedance = (shaft.K - w * w * shaft.M).cast<Complex>() + Complex(0, w) * (shaft.C - w * shaft.G).cast<Complex>();
  const Eigen::Matrix<Complex, Eigen::Dynamic, 1> load = w * w * (shaft.unbalance.col(0).cast<Complex>() - Complex(0, 1) * shaft.unbalance.col(1).cast<Complex>());
  const Complex turn(std::cos(w * t), std::sin(w * t));
  const Eigen::Matrix<Complex, Eigen::Dynamic, 1> q = impedance.fullPivLu().solve(load) * turn;
  ShaftVector motion(2 * shaft.size());
  motion << q.real(), (q * Complex(0, w)).real();
  return motion;
}

/// The same model in both coordinates, and states that belong together.
struct BothForms {
  explicit BothForms(ShaftRotorParameters p) : omega(p.rotor_speed), matrices(assembleShaft(p.shaft)) {
    p.modal = true;
    modal = makeShaftRotorModel(p);
    p.modal = false;
    physical = makeShaftRotorModel(p);
    for (const ShaftDof dof : {kShaftX, kShaftY})
      if (!p.journals.empty()) matrices.C(shaftRow(p.journals[0], dof), shaftRow(p.journals[0], dof)) += p.linearised_film_damping;
    energy = energyCoordinates(matrices, omega);
    to_modes = diagonalForm(energy.H).inverse * energy.from_physical;
  }
  Vector modalState(double t, const Vector& motion) const {
    const Index m = matrices.size();
    const Vector z = (to_modes * (motion.cast<ShaftReal>() - steadyMotion(matrices, omega, t))).cast<double>();
    Vector x(2 * m + 2);
    x << z.head(m), std::cos(omega * t), z.tail(m), std::sin(omega * t);
    return x;
  }
  double omega;
  ShaftMatrices matrices;
  EnergyCoordinates energy;
  ShaftMatrix to_modes;
  std::unique_ptr<SubsystemModel> modal, physical;
};

Vector output(SubsystemModel& model, std::size_t port, double t, const Vector& x, const Vector& u) {
  Vector y = Vector::Zero(model.outputs()[port].size);
  model.evalOutput(static_cast<Index>(port), t, in(x), in(u), view(y));
  return y;
}
Vector derivatives(SubsystemModel& model, double t, const Vector& x, const Vector& u) {
  Vector f = Vector::Zero(x.size());
  model.evalDerivatives(t, in(x), in(u), view(f));
  return f;
}

/// Inputs: drive (3), two journal forces.
Vector someInputs(std::mt19937& random, bool deviation) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Vector u = Vector::Zero(7);
  if (deviation) u.head(3) << 3.0 * unit(random), 200.0 * unit(random), 500.0 * unit(random);
  for (Index i = 3; i < 7; ++i) u[i] = 300.0 * unit(random);
  return u;
}

TEST(ShaftRotor, modalAndPhysicalCoordinatesGiveTheSameOutputsAndDerivatives) {
  BothForms both(everything());
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  ASSERT_EQ(both.modal->outputs().size(), both.physical->outputs().size());
  double worst_output = 0.0, worst_derivative = 0.0;
  for (int k = 0; k < 40; ++k) {
    const double t = 0.1 * k;
    const Vector u = someInputs(random, k % 2 == 1);
    Vector motion(2 * both.matrices.size());
    for (Index i = 0; i < motion.size(); ++i) motion[i] = (i < both.matrices.size() ? 1e-5 : 1e-2) * unit(random);
    const Vector x = both.modalState(t, motion), f_modal = derivatives(*both.modal, t, x, u), f_physical = derivatives(*both.physical, t, motion, u);
    for (std::size_t port = 0; port < both.modal->outputs().size(); ++port) {
      const OutputPort declared = both.modal->outputs()[port];
      const Vector a = output(*both.modal, port, t, x, u), b = output(*both.physical, port, t, motion, u);
      worst_output = std::max(worst_output, (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff());
      EXPECT_LE((a - b).cwiseAbs().maxCoeff(), 1e-11 * b.cwiseAbs().maxCoeff()) << declared.name;
      if (declared.size == 1) continue;
      // Every other port is linear in the state alone: its rate is the port at f.
      const Vector da = output(*both.modal, port, t, f_modal, u), db = output(*both.physical, port, t, f_physical, u);
      worst_derivative = std::max(worst_derivative, (da - db).cwiseAbs().maxCoeff() / db.cwiseAbs().maxCoeff());
      EXPECT_LE((da - db).cwiseAbs().maxCoeff(), 1e-9 * db.cwiseAbs().maxCoeff()) << declared.name;
    }
  }
  report("modal against physical coordinates, outputs", worst_output);
  report("modal against physical coordinates, derivatives", worst_derivative);
}

TEST(ShaftRotor, newtonsLawHoldsForTheNodes) {
  // M q'' + (C - omega G) q' + K q = forces, written out with the unbalance of every disc: physical coordinates against the matrices.
  const ShaftRotorParameters p = everything();
  ShaftRotorParameters physical = p;
  physical.modal = false;
  auto model = makeShaftRotorModel(physical);
  const ShaftMatrices shaft = assembleShaft(p.shaft);
  const Index n = shaft.size();
  std::mt19937 random(8);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int k = 0; k < 20; ++k) {
    const double t = 0.03 * k;
    const Vector u = someInputs(random, true);
    Vector x(2 * n);
    for (Index i = 0; i < 2 * n; ++i) x[i] = (i < n ? 1e-5 : 1e-2) * unit(random);
    const Vector f = derivatives(*model, t, x, u);
    const double omega = p.rotor_speed + u[1], psi = p.rotor_speed * t + u[0];
    Vector force = Vector::Zero(n);
    for (std::size_t j = 0; j < 2; ++j) force.segment(shaftRow(p.journals[j], kShaftX), 2) += u.segment(3 + 2 * static_cast<Index>(j), 2);
    for (const ShaftDisc& disc : p.shaft.discs) {
      const double angle = psi + disc.unbalance_angle;
      force[shaftRow(disc.node, kShaftX)] += disc.unbalance * (omega * omega * std::cos(angle) + u[2] * std::sin(angle));
      force[shaftRow(disc.node, kShaftY)] += disc.unbalance * (omega * omega * std::sin(angle) - u[2] * std::cos(angle));
    }
    const Matrix K = shaft.K.cast<double>(), D = (shaft.C - static_cast<ShaftReal>(omega) * shaft.G).cast<double>();
    const Vector balance = shaft.M.cast<double>() * f.tail(n) + D * x.tail(n) + K * x.head(n) - force;
    EXPECT_LE(balance.cwiseAbs().maxCoeff(), 1e-11 * (K.cwiseAbs() * x.head(n).cwiseAbs()).maxCoeff()) << k;
    EXPECT_EQ(Vector(f.head(n)), Vector(x.tail(n)));
  }
}

TEST(ShaftRotor, stagesReadTheMotionOfTheJournalsAlone) {
  ShaftRotorParameters p = everything();
  for (const bool modal : {true, false}) {
    p.modal = modal;
    const auto shaft = makeShaftRotorModel(p);
    ASSERT_NE(shaft->narrowForm(), nullptr);
    EXPECT_EQ(shaft->narrowForm()->C.rows(), 8) << "two journals";
    EXPECT_EQ(shaft->narrowForm()->B.cols(), modal ? 4 : 6) << "two forces each; the unbalance where S does not hold it";
  }
  p.journals.clear();
  EXPECT_EQ(makeShaftRotorModel(p)->narrowForm(), nullptr);

  const auto shipped_one = buildSimulation(shipped("dual_disc.yaml", {}));
  EXPECT_TRUE(shipped_one->system().hasNarrowForms());
  EXPECT_EQ(shipped_one->system().stageSize(), 4);
  EXPECT_EQ(shipped_one->system().stageRemainderSize(), 2);
}

TEST(ShaftRotor, startsAtRest) {
  for (const char* coordinates : {"modal", "physical"}) {
    auto simulation = buildSimulation(shipped("dual_disc.yaml", {std::string("subsystems.shaft.coordinates=") + coordinates}));
    const Vector y = look(*simulation, {"shaft.disc_1_x", "shaft.disc_2_y", "shaft.journal_y", "shaft.journal_x_rate", "shaft.node_8_x", "shaft.energy"});
    EXPECT_LE(y.cwiseAbs().maxCoeff(), 1e-15) << coordinates;  // of steady displacements of 4e-5 m and rates of 2e-2 m/s
  }
}

TEST(ShaftRotor, initialValuesMoveTheStart) {
  auto simulation = buildSimulation(shipped("dual_disc.yaml", {"subsystems.shaft.coordinates=physical", "subsystems.shaft.initial={node_2_x: 1.0e-5, node_7_y_rate: 0.01}"}));
  const Vector y = look(*simulation, {"shaft.disc_1_x", "shaft.journal_y_rate"});
  EXPECT_EQ(y[0], 1e-5);
  EXPECT_EQ(y[1], 0.01);
}

TEST(ShaftRotor, withoutFilmTheUnbalanceResponseIsSteadyToRoundOff) {
  // In modal coordinates the steady orbit is the exponential's own: z = 0 stays, whatever the step.
  ShaftRotorParameters p = everything();
  p.linearised_film_damping = 0.0;
  BothForms both(p);
  const Vector u = Vector::Zero(7);
  const Vector x = both.modalState(0.7, steadyMotion(both.matrices, p.rotor_speed, 0.7).cast<double>());
  Vector remainder = Vector::Zero(x.size());
  both.modal->evalRemainder(0.7, in(x), in(u), view(remainder));
  EXPECT_EQ(remainder, Vector::Zero(x.size()));
  const Vector expected = steadyMotion(both.matrices, p.rotor_speed, 0.7).cast<double>(), displacement = output(*both.modal, 0, 0.7, x, u);
  for (Index i = 0; i < 2; ++i)
    for (Index axis : {0, 1}) {
      const double value = expected[shaftRow(p.shaft.discs[static_cast<std::size_t>(i)].node, kShaftX) + axis];
      EXPECT_NEAR(displacement[2 * i + axis], value, 1e-12 * std::abs(value));
    }
}

/// The largest error of E(t + h) - E(t - h) = integral of the power over 2 h (Simpson), over the largest change of energy.
double energyError(const Overrides& overrides, long steps) {
  auto simulation = buildSimulation(shipped("dual_disc.yaml", overrides));
  Recorder record(*simulation, {"shaft.energy", "shaft.dissipated_power", "shaft.unbalance_power", "shaft.journal_x_rate", "shaft.journal_y_rate", "film.film_force_x", "film.film_force_y"});
  EXPECT_TRUE(advance(*simulation, steps));
  const double h = simulation->stepSize();
  const auto power = [](const Vector& row) { return row[2] - row[1] + row[3] * row[5] + row[4] * row[6]; };
  double worst = 0.0, change = 0.0;
  for (std::size_t k = 1; k + 1 < record.rows.size(); ++k) {
    const double difference = record.rows[k + 1][0] - record.rows[k - 1][0];
    const double work = h / 3.0 * (power(record.rows[k - 1]) + 4.0 * power(record.rows[k]) + power(record.rows[k + 1]));
    worst = std::max(worst, std::abs(difference - work));
    change = std::max(change, std::abs(difference));
  }
  EXPECT_GT(change, 0.0);
  return worst / change;
}

TEST(ShaftRotor, energyIsTheWorkOfForcesLessDissipation) {
  // A run-up past the first critical speed, unequal bearings with dampers; forces change with h^4 / 90 of their fourth derivative.
  const Overrides run{"simulation.step=2.0e-6", "subsystems.drive={type: speed_ramp, initial_speed_rpm: 4000, final_speed_rpm: 5000, acceleration_rpm_per_s: 2.0e+4}",
                      "subsystems.shaft.bearings.stiffness_x=[1.0e+8, 5.7e+6]", "subsystems.shaft.bearings.stiffness_y=[3.0e+7, 4.0e+6]",
                      "subsystems.shaft.bearings.damping_x=[300.0, 100.0]", "subsystems.shaft.bearings.damping_y=[100.0, 50.0]", "subsystems.shaft.stiffness_damping=1.0e-6"};
  for (const char* coordinates : {"modal", "physical"})
    for (const char* film : {"0.0", "900.0"}) {
      const double error = energyError(run + Overrides{std::string("subsystems.shaft.coordinates=") + coordinates, std::string("subsystems.shaft.linearised_film_damping=") + film}, 20000);
      report(std::string("energy balance, ") + coordinates + ", film damping in S " + film, error);
      EXPECT_LE(error, 1e-7);
    }
}

TEST(ShaftRotor, runUpThroughTheFirstCriticalSpeedAgreesInBothCoordinates) {
  const auto runUp = [](const char* coordinates, double h) {
    auto simulation = buildSimulation(shipped("dual_disc.yaml", {std::string("subsystems.shaft.coordinates=") + coordinates, set("simulation.step", h),
                                                                 "subsystems.drive={type: speed_ramp, initial_speed_rpm: 2000, final_speed_rpm: 6000, acceleration_rpm_per_s: 1.0e+4}"}));
    Recorder record(*simulation, {"shaft.disc_1_x", "shaft.disc_1_y", "shaft.rotor_speed", "shaft.azimuth"}, static_cast<std::uint64_t>(std::lround(1e-3 / h)));
    EXPECT_TRUE(advance(*simulation, std::lround(0.45 / h)));
    return record.rows;
  };
  const auto modal = runUp("modal", 1e-5), physical = runUp("physical", 1e-5);
  ASSERT_EQ(modal.size(), physical.size());
  double difference = 0.0, peak = 0.0, peak_speed = 0.0, begin = 0.0, end = 0.0;
  for (std::size_t k = 0; k < modal.size(); ++k) {
    difference = std::max(difference, (modal[k].head(2) - physical[k].head(2)).cwiseAbs().maxCoeff());
    const double radius = modal[k].head(2).norm();
    if (radius > peak) {
      peak = radius;
      peak_speed = modal[k][2] * 30.0 / kPi;
    }
    if (k > 20 && k < 50) begin = std::max(begin, radius);
    if (k + 30 > modal.size()) end = std::max(end, radius);
  }
  report("run-up, modal against physical", difference / peak);
  report("run-up, largest orbit at [rpm]", peak_speed);
  report("run-up, largest orbit over that at 2000 rpm", peak / begin);
  EXPECT_LE(difference, 1e-6 * peak);
  EXPECT_GT(peak_speed, 4231.0);  // the resonance lags behind the critical speed
  EXPECT_LT(peak_speed, 5500.0);
  EXPECT_GT(peak, 2.0 * begin);
  EXPECT_NEAR(modal.back()[2], 6000.0 * kPi / 30.0, 1e-12 * modal.back()[2]);
  // Half of the sum of speeds over the ramp of 0.4 s, then 6000 rpm until the last instant that was seen, 0.449 s.
  EXPECT_NEAR(modal.back()[3], (4000.0 * 0.4 + 6000.0 * 0.049) * kPi / 30.0, 1e-9);
}

TEST(ShaftRotor, bearingForcesCarryTheShaft) {
  // Slowly turning and without film, bearings hold what the unbalance does: sum of forces = U omega^2 to the ratio of the speeds squared.
  ShaftRotorParameters p = everything();
  p.linearised_film_damping = 0.0;
  p.rotor_speed = 1.0;
  p.shaft.discs[1].unbalance = 0.0;
  p.shaft.discs[0].unbalance_angle = 0.0;
  p.shaft.mass_damping = 0.0;
  BothForms both(p);
  const Vector x = both.modalState(0.0, steadyMotion(both.matrices, 1.0, 0.0).cast<double>()), u = Vector::Zero(7);
  for (std::size_t port = 0; port < both.modal->outputs().size(); ++port) {
    if (both.modal->outputs()[port].name != "bearing_force") continue;
    const Vector force = output(*both.modal, port, 0.0, x, u);
    EXPECT_NEAR(force[0] + force[2], -2.6e-4, 1e-4 * 2.6e-4);  // (1 / 300)^2 = 1e-5
    EXPECT_NEAR(force[1] + force[3], 0.0, 1e-4 * 2.6e-4);
    return;
  }
  FAIL() << "no bearing_force";
}

TEST(ShaftRotor, mistakesAreToldWithTheirPlace) {
  const auto problemOf = [](const std::string& override) -> std::string {
    try {
      buildSimulation(shipped("dual_disc.yaml", {override}));
    } catch (const ConfigurationError& error) {
      return error.what();
    }
    return "built";
  };
  const auto expectTold = [&](const std::string& override, const std::string& part) { EXPECT_NE(problemOf(override).find(part), std::string::npos) << override << ": " << problemOf(override); };
  expectTold("subsystems.shaft.journals=[9]", "0..8");
  expectTold("subsystems.shaft.discs.nodes=[2, 3.5]", "0..8");
  expectTold("subsystems.shaft.discs.mass=[1.0, 2.0, 3.0]", "list of 2");
  expectTold("subsystems.shaft.diameter=[0.03, 0.04]", "one per segment (8, not 2)");
  expectTold("subsystems.shaft.discs.polar_inertia=1.0", "twice the diametral inertia");
  expectTold("subsystems.shaft.inner_diameter=0.04", "inner < outer");
  expectTold("subsystems.shaft.coordinates=mode", "did you mean");
  expectTold("subsystems.shaft.bearings.stiffness_z=1.0", "stiffness_z");
  expectTold("subsystems.shaft.bearings={nodes: [1], stiffness_x: 1.0e+9, stiffness_y: 1.0e+9}", "can move freely");
}

TEST(ShaftRotor, undampedResonanceAtNominalSpeedIsRefused) {
  // A disc in the middle of a shaft without mass to speak of, on stiff bearings: k / m = nominal speed squared.
  ShaftRotorParameters p;
  p.shaft = uniformShaft(2, 0.4, 0.02, 1e12);
  p.shaft.density = 1e-3;
  p.shaft.discs = {{1, 5.0, 0.01, 0.02, 1e-5, 0.0}};
  double nearest = 1e9;
  for (const auto& eigenvalue : diagonalForm(energyCoordinates(assembleShaft(p.shaft), 300.0).H).eigenvalues)
    if (eigenvalue.imag() < nearest) nearest = static_cast<double>(eigenvalue.imag());  // the bouncing mode has no gyroscopic moment
  p.rotor_speed = nearest;
  EXPECT_THROW(makeShaftRotorModel(p), std::runtime_error);
  p.shaft.mass_damping = 1.0;
  EXPECT_NO_THROW(makeShaftRotorModel(p));
}

}  // namespace
}  // namespace heerk_rotor
