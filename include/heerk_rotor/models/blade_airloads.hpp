#pragma once
#include <vector>

#include "heerk_rotor/aero/section_loads.hpp"
#include "heerk_rotor/aero/unsteady_lift.hpp"
#include "heerk_rotor/core/subsystem_model.hpp"
#include "heerk_rotor/models/blade_polars.hpp"
#include "heerk_rotor/models/rotor_sections.hpp"

namespace heerk_rotor {

/// Blade-element airloads of 2 to 8 blades at the sections of an fe_rotor.
///
/// R_k are the axes that turn with blade k: x outboard, y towards the leading edge, z along the shaft. t (towards the leading edge) and
/// n (up) are the axes of a section before pitch, perpendicular to the deformed blade. The air moves relative to a section with
///   V = wind - lambda Omega R z - section_velocity,   lambda = l0 + r/R (l1s sin psi_k + l1c cos psi_k)
/// (lambda is only the induced flow: the hub's motion through the air is in section_velocity and wind; Omega is the nominal speed). Then
///   U_T = -V.t,   U_P = -V.n - (p - x_ea) c theta',   alpha = theta - atan2(U_P, U_T),   Mach = sqrt(U_T^2 + U_P^2) / a
/// where p is the point of the chord at which the angle of attack is taken (parts of c, like the elastic axis x_ea); flow along the
/// blade is dropped. sectionLoads() gives the loads per span; the force width (vertical n - inplane t) is a vector in R_k.
/// theta' is the rate at which a section turns nose up about its own span t x n: pitch rate, hub speed and mount rates along it.
///
/// Options
///   angle_of_attack_point  three_quarter_chord: U_P there (quasi-steady thin airfoil theory); quarter_chord
///   unsteady   lag of the circulatory lift: two states per section and blade with the downwash w = U_T sin theta - U_P cos theta,
///              wagner (R. T. Jones), or beddoes, the same with s (1 - Mach^2) for s and Beddoes' coefficients
///   virtual_mass  non-circulatory lift and moment of a flat plate (Theodorsen, NACA 496) with b = c/2, along the section's normal:
///              L = pi rho b^2 (-acceleration of the elastic axis at mid-chord + U theta' at 3/4 chord). Terms of theta'' and of changing
///              wind are left out. The loads then react to the acceleration they cause: an algebraic loop with the blade.
///   inflow_position  deformed: lambda at the displaced section (section_position) instead of at radius r on the straight blade
///
/// Inputs, per section [section][component][blade]: section_position (read only with inflow_position deformed), section_velocity,
/// section_axes, section_pitch; section_pitch_rate if the point of the angle of attack is not the elastic axis or with virtual_mass;
/// section_acceleration (inertial, without gravity) with virtual_mass. Further hub_motion, mount_velocity, hub_wind, inflow.
/// Outputs: section_loads (for the fe_rotor), rotor_loads and hub_flow (for inflow models), angle_of_attack, mach.
/// States: none, or with `unsteady` lag_<section>_<1 or 2>_<blade>; zero initial values mean steady lift.
/// Tip loss is the factor B. (Prandtl's factor divides the inflow of one annulus; it does not fit an inflow given for the whole disc.)
/// Valid: attached flow and stall as the polar has it; no dynamic stall, no yawed flow, Mach up to the table's end.
class BladeAirloads : public SubsystemModel {
 public:
  enum class AnglePoint { kQuarterChord, kThreeQuarterChord };
  enum class Unsteady { kNone, kWagner, kBeddoes };
  enum class InflowPosition { kUndeformed, kDeformed };

  struct Parameters {
    RotorSections sections;
    BladePolars polars;
    std::vector<double> chord;        // (sections) [m]
    double elastic_axis = 0.25;       // behind the leading edge [parts of chord]
    double tip_loss_factor = 1.0;     // B: no lift outside B R, spread over 1 % of R and averaged over each section's segment; 1 is none
    Air air;
    bool compressible = true;         // false: polars at Mach 0
    double rotor_speed = 44.4;        // Omega, nominal [rad/s]
    SectionKinematics kinematics = SectionKinematics::kFull;
    AnglePoint angle_of_attack_point = AnglePoint::kQuarterChord;
    Unsteady unsteady = Unsteady::kNone;
    bool virtual_mass = false;
    InflowPosition inflow_position = InflowPosition::kUndeformed;
  };

  /// parameters.polars and .chord fit parameters.sections.
  explicit BladeAirloads(const Parameters& parameters);

  std::vector<State> states() const override;
  std::vector<InputPort> inputs() const override;
  std::vector<OutputPort> outputs() const override;
  void evalOutput(Index port, double t, const In& x, const In& u, Out y) noexcept override;
  void evalOutputs(const PortValue* values, Index count, double t, const In& x, const In& u) noexcept override;
  void evalDerivatives(double t, const In& x, const In& u, Out xdot) noexcept override;
  /// Lag states that are zero get the value of steady flow. (Inflow from a model without states is not solved at that point; then
  /// the lift starts with a transient of some chord lengths.)
  void completeInitialState(const In& u, Out x) const override;

 private:
  /// Where the input ports begin in u; those that are absent are not read.
  struct Inputs {
    Index position, velocity, axes, pitch, pitch_rate, acceleration, motion, mount, wind, inflow, end;
  };
  /// Everything that can be asked for at one (x, u), in the layout of the ports.
  struct Results {
    std::vector<double> loads, alpha, mach, xdot, steady_x;
    double rotor_loads[3];
  };
  template <int N>
  struct Flow;
  template <int N>
  struct Blades;

  bool readsPitchRate() const { return flow_arm_ != 0.0 || p_.virtual_mass; }
  const Results& resultsAt(const double* x, const double* u) noexcept;
  template <int N>
  void evaluate(const double* x, const double* u, Results& results) const noexcept;
  template <int N>
  void readFlow(Index section, const Blades<N>& blades, const double* u, Flow<N>& flow) const noexcept;
  template <int N>
  void applyLag(Index section, const double* x, Flow<N>& flow, Results& results) const noexcept;
  template <int N>
  void addVirtualMass(Index section, const double* u, const Flow<N>& flow, SectionLoads<N>& loads) const noexcept;

  Parameters p_;
  Inputs in_;
  Air polar_air_;                        // speed of sound infinite if not compressible
  double flow_arm_;                      // from the elastic axis back to the point of the angle of attack [parts of chord]
  double reference_force_;               // rho A (Omega R)^2 [N]
  IndicialLag lag_;
  std::vector<BladeSection> geometry_;   // (sections)
  std::vector<double> turn_cosine_, turn_sine_;  // (lanes) of blade k behind blade 1

  // evalOutput and evalDerivatives are pure functions of (x, u). As solvers ask for several ports at the same (x, u), the last results
  // are kept together with the bits of what they were computed from, and used again only if all bits agree.
  Results results_;
  std::vector<double> key_;
  bool key_valid_ = false;
};

}  // namespace heerk_rotor
