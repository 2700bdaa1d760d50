#include "heerk_rotor/models/blade_airloads.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "heerk_rotor/aero/tip_loss.hpp"
#include "heerk_rotor/models/hub_motion.hpp"
#include "model_factories.hpp"

namespace heerk_rotor {
namespace {

enum Output_ { kSectionLoads, kRotorLoads, kHubFlow, kAngleOfAttack, kMach };
const std::vector<std::string> kVector{"x", "y", "z"};

}  // namespace

BladeAirloads::BladeAirloads(const Parameters& parameters) : p_(parameters), polar_air_(p_.air), lag_(IndicialLag::jones()) {
  const RotorSections& sections = p_.sections;
  if (!p_.compressible) polar_air_.speed_of_sound = std::numeric_limits<double>::infinity();
  flow_arm_ = (p_.angle_of_attack_point == AnglePoint::kThreeQuarterChord ? 0.75 : 0.25) - p_.elastic_axis;
  const double tip_speed = p_.rotor_speed * sections.radius;
  reference_force_ = p_.air.density * M_PI * sections.radius * sections.radius * tip_speed * tip_speed;
  // Compressibility is in the speed, see applyLag().
  if (p_.unsteady == Unsteady::kBeddoes) lag_ = IndicialLag::beddoes(0.0);

  // The segments that the sections stand for end at the tip.
  double inner = sections.radius;
  for (const double width : sections.width) inner -= width;
  for (Index j = 0; j < sections.count(); ++j) {
    const double outer = inner + sections.width[j];
    geometry_.push_back({p_.chord[j], p_.elastic_axis, meanTipLossFactor(inner / sections.radius, outer / sections.radius, p_.tip_loss_factor)});
    inner = outer;
  }
  for (int k = 0; k < 8; ++k) {
    const double behind = k < sections.blades ? 2.0 * M_PI * k / sections.blades : 0.0;
    turn_cosine_.push_back(std::cos(behind));
    turn_sine_.push_back(std::sin(behind));
  }

  Index begin = 0;
  const auto next = [&](Index size) { return begin += size, begin - size; };
  in_.position = next(sections.portSize(3));
  in_.velocity = next(sections.portSize(3));
  in_.axes = next(sections.portSize(6));
  in_.pitch = next(sections.portSize(1));
  in_.pitch_rate = next(readsPitchRate() ? sections.portSize(1) : 0);
  in_.acceleration = next(p_.virtual_mass ? sections.portSize(3) : 0);
  in_.motion = next(4);
  in_.mount = next(6);
  in_.wind = next(3);
  in_.inflow = next(3);
  in_.end = begin;

  const auto size = [&](Index components) { return static_cast<std::size_t>(sections.portSize(components)); };
  const std::size_t state_size = p_.unsteady == Unsteady::kNone ? 0 : size(2);
  results_ = {std::vector<double>(size(4)), std::vector<double>(size(1)), std::vector<double>(size(1)), std::vector<double>(state_size), std::vector<double>(state_size), {}};
  key_.resize(state_size + static_cast<std::size_t>(in_.end));
}

std::vector<State> BladeAirloads::states() const {
  std::vector<State> list;
  if (p_.unsteady == Unsteady::kNone) return list;
  for (const std::string& name : sectionEntryNames("lag", {"1", "2"}, p_.sections))
    list.push_back({name, "m/s", "past downwash in the lagging lift (section, number, blade); 0: that of steady lift at the start"});
  return list;
}

std::vector<InputPort> BladeAirloads::inputs() const {
  const RotorSections& s = p_.sections;
  const Unconnected position = p_.inflow_position == InflowPosition::kDeformed ? Unconnected::kError : Unconnected::kDefault;
  std::vector<InputPort> list{
      {"section_position", s.portSize(3), "m", "of the elastic axis at each section, in R_k", position, {}, sectionEntryNames("position", kVector, s)},
      {"section_velocity", s.portSize(3), "m/s", "of the elastic axis at each section relative to the earth, in R_k", Unconnected::kError, {}, sectionEntryNames("velocity", kVector, s)},
      {"section_axes", s.portSize(6), "-", "unit vectors across the deformed blade before pitch, in R_k: t towards the leading edge, n up", Unconnected::kError, {},
       sectionEntryNames("axis", {"t_x", "t_y", "t_z", "n_x", "n_y", "n_z"}, s)},
      {"section_pitch", s.portSize(1), "rad", "pitch of each section against t, nose up", Unconnected::kError, {}, sectionEntryNames("pitch", {""}, s)}};
  if (readsPitchRate())
    list.push_back({"section_pitch_rate", s.portSize(1), "rad/s", "rate of section_pitch", Unconnected::kError, {}, sectionEntryNames("pitch_rate", {""}, s)});
  if (p_.virtual_mass)
    list.push_back({"section_acceleration", s.portSize(3), "m/s^2", "inertial acceleration of the elastic axis at each section (without gravity), in R_k", Unconnected::kError, {},
                    sectionEntryNames("acceleration", kVector, s)});
  list.push_back(hubMotionInput());
  list.push_back({"mount_velocity", 6, "m/s, rad/s", "velocity of the hub centre and angular velocity of the mount, in hub_link", Unconnected::kDefault, {},
                  {"x", "y", "z", "roll", "pitch", "yaw"}});
  list.push_back({"hub_wind", 3, "m/s", "velocity of the air over the ground, in hub_link", Unconnected::kDefault, {}, kVector});
  list.push_back({"inflow", 3, "-", "induced flow over Omega R, downwards positive: mean, sine and cosine part", Unconnected::kDefault, {}, {"mean", "sine", "cosine"}});
  return list;
}

std::vector<OutputPort> BladeAirloads::outputs() const {
  const RotorSections& s = p_.sections;
  std::vector<std::string> flow{"section_velocity", "section_axes", "hub_motion", "hub_wind", "inflow"};
  if (p_.inflow_position == InflowPosition::kDeformed) flow.push_back("section_position");
  // With small angles the speed is that along t, in which pitch rates have no part.
  std::vector<std::string> speed = flow;
  if (flow_arm_ != 0.0) flow.insert(flow.end(), {"section_pitch_rate", "mount_velocity"});
  if (p_.kinematics == SectionKinematics::kFull) speed = flow;
  std::vector<std::string> angle = flow;
  angle.push_back("section_pitch");
  std::vector<std::string> all = angle;
  if (p_.virtual_mass) {
    all.push_back("section_acceleration");
    if (flow_arm_ == 0.0) all.insert(all.end(), {"section_pitch_rate", "mount_velocity"});
  }

  std::vector<std::string> load_units;
  for (Index j = 0; j < s.count(); ++j)
    for (int c = 0; c < 4; ++c) load_units.insert(load_units.end(), s.blades, c < 3 ? "N" : "N m");
  return {{"section_loads", s.portSize(4), "N, N m", "force on each segment in R_k, then its moment about the elastic axis, nose up", all, 1e3,
           sectionEntryNames("load", {"x", "y", "z", "moment"}, s), false, load_units},
          {"rotor_loads", 3, "-", "aerodynamic thrust coefficient and its first harmonics over the disc", all, 5e-3, {"thrust", "sine", "cosine"}},
          {"hub_flow", 3, "-", "velocity of the hub through the air in hub_link over Omega R (forward, left, up)", {"mount_velocity", "hub_wind"}, 0.1, {"forward", "left", "up"}},
          {"angle_of_attack", s.portSize(1), "rad", "at which the polar is read", angle, 0.1, sectionEntryNames("alpha", {""}, s)},
          {"mach", s.portSize(1), "-", "Mach number of the flow across each section", speed, 0.5, sectionEntryNames("mach", {""}, s)}};
}

const BladeAirloads::Results& BladeAirloads::resultsAt(const double* x, const double* u) noexcept {
  const std::size_t state_size = results_.xdot.size();
  const Index begin = p_.inflow_position == InflowPosition::kDeformed ? in_.position : in_.velocity;
  const std::size_t x_bytes = state_size * sizeof(double), u_bytes = static_cast<std::size_t>(in_.end - begin) * sizeof(double);
  double* const key_u = key_.data() + state_size;
  if (key_valid_ && std::memcmp(key_u, u + begin, u_bytes) == 0 && (x_bytes == 0 || std::memcmp(key_.data(), x, x_bytes) == 0)) return results_;
  if (p_.sections.blades <= 4)
    evaluate<4>(x, u, results_);
  else
    evaluate<8>(x, u, results_);
  if (x_bytes > 0) std::memcpy(key_.data(), x, x_bytes);
  std::memcpy(key_u, u + begin, u_bytes);
  key_valid_ = true;
  return results_;
}

void BladeAirloads::evalOutput(Index port, double t, const In& x, const In& u, Out y) noexcept {
  const PortValue value{port, y.data(), y.size()};
  evalOutputs(&value, 1, t, x, u);
}

void BladeAirloads::evalOutputs(const PortValue* values, Index count, double, const In& x, const In& u) noexcept {
  const Results* results = nullptr;  // of all ports, looked for once
  for (const PortValue* value = values; value != values + count; ++value) {
    if (value->port == kHubFlow) {
      const double scale = 1.0 / (p_.rotor_speed * p_.sections.radius);
      for (Index i = 0; i < 3; ++i) value->y[i] = scale * (u[in_.mount + i] - u[in_.wind + i]);
      continue;
    }
    if (!results) results = &resultsAt(x.data(), u.data());
    const double* from = results->loads.data();
    if (value->port == kRotorLoads) from = results->rotor_loads;
    if (value->port == kAngleOfAttack) from = results->alpha.data();
    if (value->port == kMach) from = results->mach.data();
    std::copy_n(from, value->size, value->y);
  }
}

void BladeAirloads::evalDerivatives(double, const In& x, const In& u, Out xdot) noexcept {
  if (results_.xdot.empty()) return;
  const Results& results = resultsAt(x.data(), u.data());
  std::copy(results.xdot.begin(), results.xdot.end(), xdot.data());
}

void BladeAirloads::completeInitialState(const In& u, Out x) const {
  if (results_.xdot.empty()) return;
  Results steady = results_;
  if (p_.sections.blades <= 4)
    evaluate<4>(x.data(), u.data(), steady);
  else
    evaluate<8>(x.data(), u.data(), steady);
  for (Index i = 0; i < x.size(); ++i)
    if (x[i] == 0.0 && std::isfinite(steady.steady_x[i])) x[i] = steady.steady_x[i];
}

Made makeBladeAirloads(Section& section, const BuildContext& context) {
  BladeAirloads::Parameters p;
  p.sections = sectionsOfRotor(section, context);
  p.rotor_speed = context.simulation.rotor_speed;
  std::vector<double> r;
  for (const double radius : p.sections.r) r.push_back(radius / p.sections.radius);
  p.chord = readChord(section, r);
  p.polars = readBladePolars(section, context, r);
  p.elastic_axis = section.number("elastic_axis", p.elastic_axis, "parts of the chord behind the leading edge", {0.0, 1.0, false});
  p.tip_loss_factor = section.number("tip_loss_factor", p.tip_loss_factor, "r/R", {0.5, 1.0, false});
  p.air.density = section.number("air_density", p.air.density, "kg/m^3", positive());
  p.air.speed_of_sound = section.number("speed_of_sound", p.air.speed_of_sound, "m/s", positive());
  p.compressible = section.flag("compressible", p.compressible);
  if (section.word("kinematics", "full", {"full", "small_angle"}) == "small_angle") p.kinematics = SectionKinematics::kSmallAngle;
  if (section.word("angle_of_attack_point", "quarter_chord", {"quarter_chord", "three_quarter_chord"}) == "three_quarter_chord")
    p.angle_of_attack_point = BladeAirloads::AnglePoint::kThreeQuarterChord;
  const std::string unsteady = section.word("unsteady", "none", {"none", "wagner", "beddoes"});
  if (unsteady == "wagner") p.unsteady = BladeAirloads::Unsteady::kWagner;
  if (unsteady == "beddoes") p.unsteady = BladeAirloads::Unsteady::kBeddoes;
  p.virtual_mass = section.flag("virtual_mass", p.virtual_mass);
  if (section.word("inflow_position", "undeformed", {"undeformed", "deformed"}) == "deformed") p.inflow_position = BladeAirloads::InflowPosition::kDeformed;
  section.finish();
  return std::make_unique<BladeAirloads>(p);
}

}  // namespace heerk_rotor
