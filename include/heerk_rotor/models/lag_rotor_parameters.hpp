#pragma once
#include <array>

#include "heerk_rotor/config/section.hpp"
#include "heerk_rotor/models/hub_motion.hpp"

namespace heerk_rotor {

struct BuildContext;

/// How blade motion and mast twist are chosen as states (lag_rotor.md, section 5).
enum class LagFormulation {
  kPrinted,      // the paper's: blade angles relative to the hub; the mast spring's stiffness reaches them through an output
  kAbsoluteLag   // blade angles relative to the drive: all mast stiffness sits in one 2x2 block of S
};

/// Parameters of the lag rotor; defaults are Table 6 of the HEERK paper (frequencies read as rad/s).
struct LagRotorParameters {
  double hinge_offset = 0.2;          // a [m]
  double blade_length = 2.5;          // b, lag hinge to blade centre of mass [m]
  double blade_mass = 31.9;           // m_b [kg]
  double blade_inertia = 259.0;       // I_zb about the blade's centre of mass [kg m^2]
  double fuselage_mass_x = 2902.9;    // m_f, effective along x, without blades [kg]
  double fuselage_mass_y = 2902.9;    // m_f, effective along y [kg]
  std::array<double, kLagBlades> lag_frequency{{1.5, 1.5, 1.5, 1.5}};  // omega_b, hinge spring of each blade at rest [rad/s]
  std::array<double, kLagBlades> lag_damper{};                         // hinge damper of each blade [N m s/rad]
  double fuselage_frequency_x = 3.0;  // omega_x, of the complete mass on its support [rad/s]
  double fuselage_frequency_y = 3.0;  // omega_y [rad/s]
  double fuselage_damping_x = 0.0;    // c_x [N s/m]
  double fuselage_damping_y = 0.0;    // c_y [N s/m]
  bool second_order_hub_terms = true; // keep -2 a b m_b omega sum(phi phi') and the phi x'' terms in the hub row
};

/// Reads `subsystems.<rotor>`; finishes the section.
LagRotorParameters readLagRotorParameters(Section& section);

/// Ratios and inertias that the equations use (Table 6 of the paper and lag_rotor.md, section 1).
struct LagRotorConstants {
  explicit LagRotorConstants(const LagRotorParameters& parameters);

  double mass_x, mass_y;      // m_f + 4 m_b [kg]
  double r_mx, r_my;          // m_b b / mass [m]
  double static_moment;       // m_b b [kg m]
  double lag_inertia;         // I_l = m_b b^2 + I_zb about the hinge [kg m^2]
  double r_b;                 // static_moment / I_l [1/m]
  double r_a2;                // a r_b [-]
  double g;                   // 1 + r_a^2 [-]
  double hub_inertia;         // J = 4 (a+b)^2 m_b + 4 I_zb [kg m^2]
  double coupling_inertia;    // S_h = b (a+b) m_b + I_zb = J r_sb [kg m^2]
  double q;                   // 4 r_sb g [-]
  double spring[kLagBlades];  // omega_b^2 [1/s^2]
  double damper[kLagBlades];  // lag damper over I_l [1/s]
  double load;                // 1 / I_l [1/(kg m^2)]
  double per_mass_x, per_mass_y;  // 1 / mass [1/kg]
  double damping_x, damping_y;    // fuselage damping over mass [1/s]
  double spring_x, spring_y;  // omega_x^2, omega_y^2 [1/s^2]
  double gain_x, gain_y;      // 1 / (1 - 2 r_m r_b): of the fuselage's rows once the blades' accelerations are eliminated
  double kappa;               // 1 / (1 - q): amplification of the loop hub acceleration -> lag acceleration
};

/// What the mast must know of the rotor on it.
struct MastLoad {
  LagFormulation formulation = LagFormulation::kAbsoluteLag;
  double inertia = 0.0;    // that the hub acceleration works against: J, or J / kappa in absolute-lag form [kg m^2]
  double stiffness = 0.0;  // of the blades as felt by the twist at nominal speed; 0 in printed form [N m/rad]
  double damping = 0.0;    // [N m s/rad]
};
MastLoad mastLoad(const LagRotorParameters& parameters, LagFormulation formulation, double rotor_speed);

/// Parameters of the lag rotor that this context's configuration couples to a mast: the one named by `rotor:` in
/// `section`, or the only one there is. Records a problem when there is none.
LagRotorParameters rotorOfMast(Section& section, const BuildContext& context);

LagFormulation formulationOf(const BuildContext& context);

}  // namespace heerk_rotor
