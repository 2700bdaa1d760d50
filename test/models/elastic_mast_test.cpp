#include "heerk_rotor/models/elastic_mast.hpp"

#include "models/rotor_runs.hpp"

namespace heerk_rotor {
namespace {

using namespace test;

const Overrides kDamped{"subsystems.rotor.lag_damper=[259.0, 0.0, 400.0, 150.0]", "subsystems.rotor.lag_frequency=[1.5, 1.2, 1.8, 1.4]",
                        "subsystems.mast.damping=800.0", "subsystems.mast.stiffness=3.0e+5", "subsystems.rotor.initial={lag_1: 0.0}"};

TEST(ElasticMast, stiffBlockOfTheAbsoluteLagFormIsTheExactDerivative) {
  // With all dampers and unequal blades, and the second-order terms, which vanish at zero lag angle: how the twist answers
  // to itself in the coupled system, by differencing it, against the block that the exponential treats.
  for (const char* terms : {"true", "false"}) {
    ReducedOde ode(shipped("lag_rotor.yaml", kDamped + Overrides{std::string("subsystems.rotor.second_order_hub_terms=") + terms}));
    const CoupledSystem::Subsystem& mast = subsystem(ode.system, "mast");
    const Matrix jacobian = ode.jacobian(0.0, Vector::Zero(ode.system.stateSize()), 1e-6);
    const Matrix block = jacobian.block(mast.x_begin, mast.x_begin, 2, 2), S = stiffMatrix(mast.stiff);
    for (Index i = 0; i < 2; ++i)
      for (Index j = 0; j < 2; ++j) EXPECT_NEAR(block(i, j), S(i, j), 1e-8 * std::max(1.0, std::abs(S(i, j)))) << i << j << ", terms " << terms;  // central differences
  }
}

TEST(ElasticMast, stiffBlockIsTheFormulaOfLagRotorMd) {
  // Stiffness kappa (omega_s^2 + sum r_sb g k_i), damping kappa (c_mast / J + sum r_sb g c_i), c_i = damper / I_l.
  const CoupledSystem system = buildSystem(shipped("lag_rotor.yaml", kDamped));
  const auto& part = std::get<ModalStiff>(subsystem(system, "mast").stiff);
  const double g = 1.0347968366512, r_sb = 0.241238955876, J = 1966.204, kappa = 681.771855, lag_inertia = 31.9 * 6.25 + 259.0;
  double stiffness = 3e5 / J, damping = 800.0 / J;
  for (const double frequency : {1.5, 1.2, 1.8, 1.4}) stiffness += r_sb * g * (0.0347968366512 * 6.63 * 6.63 + frequency * frequency);
  for (const double damper : {259.0, 0.0, 400.0, 150.0}) damping += r_sb * g * damper / lag_inertia;
  // kappa is published with nine digits.
  EXPECT_NEAR(part.omega[0] * part.omega[0], kappa * stiffness, 1e-8 * kappa * stiffness);
  EXPECT_NEAR(part.damping[0], kappa * damping, 1e-8 * kappa * damping);
}

TEST(ElasticMast, stiffBlockOfThePrintedFormIsTheSpringAlone) {
  const CoupledSystem system = buildSystem(shipped("lag_rotor.yaml", kDamped + Overrides{"simulation.formulation=printed"}));
  const auto& part = std::get<ModalStiff>(subsystem(system, "mast").stiff);
  EXPECT_NEAR(part.omega[0], std::sqrt(3e5 / 1966.204), 1e-12);
  EXPECT_NEAR(part.damping[0], 800.0 / 1966.204, 1e-12);
}

}  // namespace
}  // namespace heerk_rotor
