// The algebraic loop through the mount: what hangs on the hub feels its acceleration and answers with a force at the same instant.
#include "heerk_rotor/core/coupling_graph.hpp"
#include "heerk_rotor/integrate/tableau.hpp"
#include "heerk_rotor/models/rigid_body_mount.hpp"
#include "models/mount_rig.hpp"

namespace heerk_rotor {
namespace {

using namespace test;

constexpr double kMass = 10.0, kHubMass = 4.0;
const Vector3d kHub(0.2, -0.1, 1.5);

/// The simplest rotor: a point mass at the hub centre, F = -m (a - g).
class HubMass : public SubsystemModel {
 public:
  std::vector<State> states() const override { return {}; }
  std::vector<InputPort> inputs() const override { return {{"mount_acceleration", 6, "m/s^2, rad/s^2", "of the hub, minus gravity"}}; }
  std::vector<OutputPort> outputs() const override { return {{"rotor_force", 3, "N", "on the fuselage", {"mount_acceleration"}, 100.0}}; }
  void evalOutput(Index, double, const In&, const In& u, Out y) noexcept override { y = -kHubMass * u.head<3>(); }
  void evalDerivatives(double, const In&, const In&, Out) noexcept override {}
};

MountParameters parametersOf(const std::string& text) {
  const Configuration configuration = loneMount(text);
  Problems problems;
  Section section(configuration, "subsystems.fuselage", problems);
  section.word("type", "");
  const MountParameters p = readMountParameters(section);
  EXPECT_TRUE(problems.empty()) << problems.text();
  return p;
}

std::unique_ptr<Simulation> rig(const MountParameters& p, const Vector& x, bool with_hub_mass) {
  CouplingGraph graph;
  graph.add("fuselage", std::make_unique<RigidBodyMount>(p));
  if (with_hub_mass) {
    graph.add("hub", std::make_unique<HubMass>());
    graph.connect("fuselage.mount_acceleration", "hub.mount_acceleration");
    graph.connect("hub.rotor_force", "fuselage.rotor_force");
  }
  StepOptions options;
  options.step = 1e-3;
  options.method = "HEERK4";
  options.solver.tolerance = 1e-13;
  auto simulation = std::make_unique<Simulation>(std::move(graph).build(), options);
  simulation->setState(x);
  return simulation;
}

TEST(MountLoop, massAtTheHubIsThatOfOneLargerBody) {
  for (const char* rotation : {"ccw", "cw"}) {
    const MountParameters p = parametersOf(std::string("mode: free, mass: 10.0, inertia: [6.0, 9.0, 8.0], products_of_inertia: [0.2, -0.3, 0.1], hub_offset: [0.2, -0.1, 1.5], shaft_tilt_forward_deg: 9.0, rotation: ") + rotation);
    Vector x = Vector::Zero(kBodyStates);
    x << 1.0, 2.0, 3.0, 0.8, 0.0, 0.6, 0.0, 4.0, -1.0, 2.0, 1.0, -2.0, 1.5;
    auto coupled = rig(p, x, true);

    // Both bodies as one: centre of gravity c from that of the fuselage, inertia with the parallel-axis theorem.
    const double reduced_mass = kMass * kHubMass / (kMass + kHubMass);
    const Vector3d c = kHubMass / (kMass + kHubMass) * kHub, rates = x.segment<3>(kRates);
    MountParameters whole = p;
    whole.mass = kMass + kHubMass;
    whole.inertia += reduced_mass * (kHub.squaredNorm() * Matrix3d::Identity() - kHub * kHub.transpose());
    whole.hub_offset = kHub - c;
    Vector x_whole = x;
    x_whole.segment<3>(kPosition) += quaternionOf(x.segment<4>(kOrientation)) * c;
    x_whole.segment<3>(kVelocity) += rates.cross(c);
    auto one = rig(whole, x_whole, false);

    // A moment on the fuselage is one on the whole; a force at its centre of gravity acts at -c from that of the whole.
    Vector w = coupled->system().defaultCommand(), w_whole = w;
    const Vector3d force(30.0, -20.0, 150.0), moment(5.0, 7.0, -3.0);
    w.head<6>() << force, moment;
    w_whole.head<6>() << force, moment - c.cross(force);
    ASSERT_TRUE(advance(*coupled, 1, w));
    const auto factorizations = coupled->solver().counters().factorizations;
    ASSERT_TRUE(advance(*coupled, 999, w) && advance(*one, 1000, w_whole));
    const std::vector<std::string> names = xyz("hub_position") + wxyz("hub_orientation") + xyz("hub_velocity") + xyz("hub_specific_force") + xyz("hub_angular_acceleration");
    const double difference = (look(*coupled, names, w) - look(*one, names, w_whole)).cwiseAbs().maxCoeff();
    report(std::string("hub mass against one body, ") + rotation, difference);
    EXPECT_LE(difference, 1e-11);  // two discretisations of order 4: 1000 steps of (3 rad/s h)^5 / 120 times 4 m; solver tolerance 1e-13 of 30 m/s^2
    // The loop is linear and the mount's gradient exact and constant: what was factorised at the start serves for good.
    EXPECT_EQ(coupled->solver().counters().factorizations, factorizations);
    report("Newton iterations per solve", static_cast<double>(coupled->solver().counters().newton_iterations) / static_cast<double>(coupled->solver().counters().solves));
  }
}

}  // namespace
}  // namespace heerk_rotor
