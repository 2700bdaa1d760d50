#include "heerk_rotor/models/fe_rotor.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <vector>

#include "blade_dynamics.hpp"
#include "fe_rotor_ports.hpp"
#include "heerk_rotor/core/branch_free_math.hpp"
#include "model_factories.hpp"

namespace heerk_rotor {
namespace {

constexpr double kTwoPi = 6.283185307179586476925;

/// L: lanes, at least the number of blades.
template <int L>
class FeRotor : public SubsystemModel {
  using Vec = LaneVector<L>;
  using Vec3 = Lanes3<L>;

 public:
  explicit FeRotor(const FeRotorParameters& parameters) : p_(parameters), blades_(parameters.sections.blades), dynamics_(parameters) {
    // Offsets of the inputs in u.
    Index begin = 0;
    std::size_t number = 0;
    for (const InputPort& port : inputs()) {
      offsets_[number++] = begin;
      begin += port.size;
    }
    for (int k = 0; k < L; ++k) {
      const double angle = kTwoPi * (k < blades_ ? k : 0) / blades_;
      blade_cosine_[k] = exactAtQuarters(std::cos(angle));
      blade_sine_[k] = exactAtQuarters(std::sin(angle));
    }
    precone_sine_ = std::sin(parameters.precone);
    axes_.precone_sine = sameLanes<L>(precone_sine_);
    axes_.precone_cosine = sameLanes<L>(std::cos(parameters.precone));
    axes_.pitch_cosine = sameLanes<L>(1.0);
    axes_key_.resize(static_cast<std::size_t>(offsets_[kLoads]));
    const BladeCoefficients& c = dynamics_.coefficients();
    for (std::size_t entry = 0; entry < c.mode_order.size(); ++entry)
      for (int k = 0; k < blades_; ++k)
        if (const double share = c.twist_share[entry * static_cast<std::size_t>(c.copies) + static_cast<std::size_t>(c.copies == 1 ? 0 : k)]; share != 0.0)
          absolute_.push_back({c.mode_order[entry] * blades_ + k, share});
  }

  std::vector<State> states() const override {
    std::vector<bool> from_drive(dynamics_.coefficients().state_names.size(), false);
    for (const Absolute& a : absolute_) from_drive[static_cast<std::size_t>(a.state)] = true;
    return feRotorStates(dynamics_.coefficients().state_names, from_drive);
  }
  std::vector<InputPort> inputs() const override { return feRotorInputs(p_.sections); }
  std::vector<OutputPort> outputs() const override { return feRotorOutputs(p_); }

  StiffPart stiffPart() const override {
    const BladeCoefficients& c = dynamics_.coefficients();
    return ModalStiff{Eigen::Map<const Vector>(c.omega.data(), static_cast<Index>(c.omega.size())),
                      Eigen::Map<const Vector>(c.damping.data(), static_cast<Index>(c.damping.size())), true};
  }

  void evalOutput(Index port, double t, const In& x, const In& u, Out y) noexcept override {
    const PortValue value{port, y.data(), y.size()};
    evalOutputs(&value, 1, t, x, u);
  }

  void evalOutputs(const PortValue* values, Index count, double, const In& x, const In& u) noexcept override {
    deform(x, u);
    bool accelerated = false;
    double* geometry[kSectionPitchRate + 1] = {};  // where the sections' ports go, all in one pass
    for (Index k = 0; k < count; ++k) {
      const Index port = values[k].port;
      if (!accelerated && (port == kSectionAcceleration || port == kRotorForce || port == kTiltingMoment || port == kBladeReaction || port == kRootLoad || port == kFlapAcceleration)) {
        accelerate(u);
        accelerated = true;
      }
      Out y(values[k].y, values[k].size);
      switch (port) {
        case kSectionPosition: case kSectionVelocity: case kSectionAxes: case kSectionPitch: case kSectionPitchRate: geometry[port] = values[k].y; break;
        case kSectionAcceleration: sectionAcceleration(u, y); break;
        case kRotorForce: case kTiltingMoment: case kBladeReaction: case kRootLoad: hubLoads(port, u, y); break;
        case kLag: case kLagRate: case kFlap: case kFlapRate: case kFlapAcceleration: case kTipTwist: tip(port, u, y); break;
        case kMomentum: case kAngularMomentum: case kEnergy: case kDissipation: balance(port, u, y); break;
      }
    }
    if (std::any_of(std::begin(geometry), std::end(geometry), [](const double* y) { return y != nullptr; })) sectionGeometry(geometry, u);
  }

  bool holdState(bool held) noexcept override {
    held_ = held;
    known_ = false;
    return true;
  }

  bool providesRemainder() const override { return true; }

  void evalRemainder(double, const In& x, const In& u, Out remainder) noexcept override {
    deform(x, u);
    accelerate(u);
    const Index n = static_cast<Index>(dynamics_.coefficients().modes) * blades_;
    remainder.head(n).setZero();
    // p'' = q'' + b twist'' where the state counts from the drive; S makes -omega^2 p - c p' of it.
    const double *motion = input(u, kHubMotion), *acceleration = input(u, kHubAcceleration);
    dynamics_.storeRemainder({motion[2], motion[3], acceleration[0] - acceleration[1]}, remainder.data() + n);
  }

  void evalDerivatives(double t, const In& x, const In& u, Out xdot) noexcept override {
    evalRemainder(t, x, u, xdot);
    const BladeCoefficients& c = dynamics_.coefficients();
    const Index n = static_cast<Index>(c.omega.size());
    for (Index i = 0; i < n; ++i) {
      xdot[i] = x[n + i];
      xdot[n + i] -= c.omega[static_cast<std::size_t>(i)] * c.omega[static_cast<std::size_t>(i)] * x[i] + c.damping[static_cast<std::size_t>(i)] * x[n + i];
    }
  }

  void completeInitialState(const In& u, Out x) const override {
    const Index n = x.size() / 2;
    for (const Absolute& a : absolute_) {  // given is the motion relative to the hub
      x[a.state] += a.share * input(u, kHubMotion)[2];
      x[n + a.state] += a.share * input(u, kHubMotion)[3];
    }
  }

 private:
  /// A state that counts from the drive.
  struct Absolute {
    Index state;   // its place among the modal coordinates
    double share;  // of the mast's twist
  };

  void deform(const In& x, const In& u) noexcept {
    const double* motion = input(u, kHubMotion);
    dynamics_.deform(x.data(), {motion[2], motion[3]}, known_);
    known_ = held_;
  }

  /// cos and sin of multiples of a quarter turn without rounding, so that opposite blades cancel exactly.
  static double exactAtQuarters(double value) { return std::abs(value) < 1e-15 ? 0.0 : std::abs(std::abs(value) - 1.0) < 1e-15 ? std::copysign(1.0, value) : value; }

  const double* input(const In& u, FeRotorInput port) const noexcept { return u.data() + offsets_[port]; }

  /// The axes depend on hub_motion, mount_velocity, pitch and pitch_rate, which begin u in this order. They are made anew only when one of
  /// these differs bitwise from last time: all ports of an instant share them. What a port does not feed through (shape: all but the pitch)
  /// has no effect on the members it reads. (The mast's twist, which is a part of every displacement where states count from the drive, is none of them.)
  const BladeAxes<L>& movingAxes(const In& u) noexcept {
    const std::size_t bytes = axes_key_.size() * sizeof(double);
    if (axes_version_ > 0 && std::memcmp(axes_key_.data(), u.data(), bytes) == 0) return axes_;
    std::memcpy(axes_key_.data(), u.data(), bytes);
    ++axes_version_;
    const Vec pitch = loadLanes<L>(input(u, kPitch), blades_);
    for (int k = 0; k < L && !p_.small_angle; ++k) {
      const SineCosine value = sineCosine(pitch[k]);
      axes_.pitch_sine[k] = value.sine;
      axes_.pitch_cosine[k] = value.cosine;
    }
    const double* motion = input(u, kHubMotion);
    const auto [s, c] = sineCosine(motion[0]);
    axes_.sine = s * blade_cosine_ + c * blade_sine_;
    axes_.cosine = c * blade_cosine_ - s * blade_sine_;
    axes_.omega = axes_.fromHub(input(u, kMountVelocity) + 3);
    axes_.omega.z += motion[1];
    axes_.speed = sameLanes<L>(motion[1]);
    if (!p_.small_angle) axes_.pitch_rate = loadLanes<L>(input(u, kPitchRate), blades_);
    return axes_;
  }

  void accelerate(const In& u) noexcept {
    const BladeAxes<L>& axes = movingAxes(u);
    dynamics_.load(axes, axes_version_, input(u, kLoads));
    HubAcceleration<L> hub{};
    const double* mount = input(u, kMountAcceleration);
    hub.linear = axes.fromHub(mount);
    hub.angular = axes.fromHub(mount + 3);
    hub.angular.z += input(u, kHubAcceleration)[0];
    // R turns relative to the mount, whose own rates change direction with it.
    hub.angular.x += axes.omega.y * axes.speed;
    hub.angular.y -= axes.omega.x * axes.speed;
    if (!p_.small_angle) hub.pitch = loadLanes<L>(input(u, kPitchAcceleration), blades_);
    dynamics_.accelerate(axes, hub);
  }

  Vec3 hubVelocity(const BladeAxes<L>& axes, const In& u) const noexcept { return axes.fromHub(input(u, kMountVelocity)); }

  void store(double* y, Index j, Index component, Index components, const Vec& value) const noexcept {
    storeLanes<L>(value, blades_, y + sectionEntry(j, component, components, 0, blades_));
  }
  void store(double* y, Index j, Index component, Index components, const Vec3& value) const noexcept {
    store(y, j, component, components, value.x);
    store(y, j, component + 1, components, value.y);
    store(y, j, component + 2, components, value.z);
  }

  /// y: by port, null where it is not asked for.
  void sectionGeometry(double* const (&y)[kSectionPitchRate + 1], const In& u) noexcept {
    const BladeAxes<L>& axes = movingAxes(u);
    const Vec pitch = loadLanes<L>(input(u, kPitch), blades_), pitch_rate = loadLanes<L>(input(u, kPitchRate), blades_);
    const Vec3 lead{Vec{}, sameLanes<L>(dynamics_.rootLead()), Vec{}};
    const Vec3 hub_velocity = hubVelocity(axes, u) + cross(axes.omega, lead), omega_B = axes.omegaOfBlade();
    for (int j = 0; j < p_.sections.count(); ++j) {
      const BladeCoefficients::SectionShape& shape = dynamics_.coefficients().shapes[static_cast<std::size_t>(j)];
      const SectionMotion<L> d = dynamics_.displacement(j), rate = dynamics_.displacementRate(j);
      const Vec3 position{sameLanes<L>(shape.radius), d.v, d.w};
      if (y[kSectionPosition]) store(y[kSectionPosition], j, 0, 3, lead + axes.fromBlade(position));
      if (y[kSectionVelocity]) store(y[kSectionVelocity], j, 0, 3, hub_velocity + axes.fromBlade(cross(omega_B, position) + Vec3{Vec{}, rate.v, rate.w}));
      if (y[kSectionAxes]) {
        Vec3 t, n;
        sectionAxes(axes, d, t, n);
        store(y[kSectionAxes], j, 0, 6, t);
        store(y[kSectionAxes], j, 3, 6, n);
      }
      if (y[kSectionPitch]) store(y[kSectionPitch], j, 0, 1, pitch + shape.built_in_twist + d.twist);
      if (y[kSectionPitchRate]) store(y[kSectionPitchRate], j, 0, 1, pitch_rate + rate.twist);
    }
  }

  /// t and n perpendicular to the deformed elastic axis, t as near to the leading-edge direction y of R as possible: with `along` the axis,
  /// n = along x y and t = n x along, each over its length.
  void sectionAxes(const BladeAxes<L>& axes, const SectionMotion<L>& d, Vec3& t, Vec3& n) const noexcept {
    if (p_.small_angle) {
      const Vec up = d.slope_w + precone_sine_;
      t = {-d.slope_v, sameLanes<L>(1.0), Vec{}};
      n = {-up, Vec{}, sameLanes<L>(1.0)};
      return;
    }
    const Vec3 along = axes.fromBlade({sameLanes<L>(1.0), d.slope_v, d.slope_w});
    const Vec square = along.x * along.x + along.z * along.z;  // of the length of n
    const Vec length = squareRoot<L>(square + along.y * along.y), inverse = 1.0 / (squareRoot<L>(square) * length);
    t = inverse * Vec3{-along.x * along.y, square, -along.z * along.y};
    n = (inverse * length) * Vec3{-along.z, Vec{}, along.x};
  }

  void sectionAcceleration(const In& u, Out& y) noexcept {
    const BladeAxes<L>& axes = movingAxes(u);
    const double* mount = input(u, kMountAcceleration);
    const double* gravity = input(u, kHubGravity);
    const double linear_H[3] = {mount[0] + gravity[0], mount[1] + gravity[1], mount[2] + gravity[2]};
    Vec3 angular = axes.fromHub(mount + 3);
    angular.z += input(u, kHubAcceleration)[0];
    angular.x += axes.omega.y * axes.speed;
    angular.y -= axes.omega.x * axes.speed;
    const Vec3 lead{Vec{}, sameLanes<L>(dynamics_.rootLead()), Vec{}};
    const Vec3 origin = axes.fromHub(linear_H) + cross(angular, lead) + cross(axes.omega, cross(axes.omega, lead));
    const Vec3 w_R = axes.toBlade(axes.omega), w = axes.omegaOfBlade();
    Vec3 alpha = axes.toBlade(angular);
    if (!p_.small_angle) alpha.x += loadLanes<L>(input(u, kPitchAcceleration), blades_);
    alpha.y += axes.pitch_rate * w_R.z;
    alpha.z -= axes.pitch_rate * w_R.y;
    for (int j = 0; j < p_.sections.count(); ++j) {
      const SectionMotion<L> d = dynamics_.displacement(j), rate = dynamics_.displacementRate(j), second = dynamics_.displacementAcceleration(j);
      const Vec3 position{sameLanes<L>(dynamics_.coefficients().shapes[static_cast<std::size_t>(j)].radius), d.v, d.w};
      const Vec3 relative{Vec{}, rate.v, rate.w};
      const Vec3 local = cross(alpha, position) + cross(w, cross(w, position)) + sameLanes<L>(2.0) * cross(w, relative) + Vec3{Vec{}, second.v, second.w};
      store(y.data(), j, 0, 3, origin + axes.fromBlade(local));
    }
  }

  double sum(const Vec& lanes) const noexcept {
    // Opposite blades first, so that what cancels on a symmetric rotor does.
    double total = 0.0;
    if (blades_ % 2 == 0) for (int k = 0; k < blades_ / 2; ++k) total += lanes[k] + lanes[k + blades_ / 2];
    else for (int k = 0; k < blades_; ++k) total += lanes[k];
    return total;
  }

  void hubLoads(Index port, const In& u, Out& y) noexcept {
    const Vec3 force = dynamics_.rootForce(), moment = dynamics_.rootMoment();
    if (port == kRootLoad) {
      for (int k = 0; k < blades_; ++k) y.segment(6 * k, 6) << force.x[k], force.y[k], force.z[k], moment.x[k], moment.y[k], moment.z[k];
      return;
    }
    const BladeAxes<L>& axes = movingAxes(u);
    const Vec3 in_hub = axes.toHub(port == kRotorForce ? force : moment);
    if (port == kBladeReaction) y[0] = sum(in_hub.z);
    else if (port == kTiltingMoment) y << sum(in_hub.x), sum(in_hub.y);
    else y << sum(in_hub.x), sum(in_hub.y), sum(in_hub.z);
  }

  void tip(Index port, const In& u, Out& y) noexcept {
    const int j = static_cast<int>(p_.sections.count());
    const SectionMotion<L> d = dynamics_.displacement(j);
    if (port == kTipTwist) {
      storeLanes<L>(d.twist, blades_, y.data());
      return;
    }
    const BladeAxes<L>& axes = movingAxes(u);
    const Vec3 position{sameLanes<L>(p_.sections.radius), d.v, d.w};
    Vec3 value = position;
    if (port != kLag && port != kFlap) {
      const SectionMotion<L> rate = dynamics_.displacementRate(j);
      const Vec3 relative{Vec{}, rate.v, rate.w}, spin{axes.pitch_rate, Vec{}, Vec{}};
      value = cross(spin, position) + relative;
      if (port == kFlapAcceleration) {
        const SectionMotion<L> second = dynamics_.displacementAcceleration(j);
        Vec3 spin_rate{};
        if (!p_.small_angle) spin_rate.x = loadLanes<L>(input(u, kPitchAcceleration), blades_);
        value = cross(spin_rate, position) + cross(spin, cross(spin, position)) + sameLanes<L>(2.0) * cross(spin, relative) + Vec3{Vec{}, second.v, second.w};
      }
    }
    const Vec3 in_R = axes.fromBlade(value);
    storeLanes<L>((port == kLag || port == kLagRate ? in_R.y : in_R.z) / p_.sections.radius, blades_, y.data());
  }

  void balance(Index port, const In& u, Out& y) noexcept {
    if (port == kDissipation) {
      y[0] = sum(dynamics_.dissipation());
      return;
    }
    const BladeAxes<L>& axes = movingAxes(u);
    if (port == kEnergy) {
      y[0] = sum(dynamics_.energy(axes, hubVelocity(axes, u)));
      return;
    }
    Vec3 linear, angular;
    dynamics_.momentum(axes, hubVelocity(axes, u), linear, angular);
    const Vec3 in_hub = axes.toHub(port == kMomentum ? linear : angular);
    y << sum(in_hub.x), sum(in_hub.y), sum(in_hub.z);
  }

  bool held_ = false, known_ = false;   // evaluations are all at one x, which has been looked at
  std::vector<Absolute> absolute_;      // states of slow modes
  FeRotorParameters p_;
  int blades_;
  BladeDynamics<L> dynamics_;
  Index offsets_[kFeRotorInputs] = {};
  Vec blade_sine_{}, blade_cosine_{};
  double precone_sine_;
  BladeAxes<L> axes_{};                // of axes_key_
  std::vector<double> axes_key_;       // (10 + 2 blades) the inputs that it was made of
  std::uint64_t axes_version_ = 0;     // 0: not made yet
};

}  // namespace

std::unique_ptr<SubsystemModel> makeFeRotorModel(const FeRotorParameters& parameters) {
  if (parameters.sections.blades <= 4) return std::make_unique<FeRotor<4>>(parameters);
  return std::make_unique<FeRotor<8>>(parameters);
}

TwistLoad twistLoad(const FeRotorParameters& parameters) {
  const BladeCoefficients c(parameters, parameters.sections.blades);
  return {c.twist_stiffness, c.twist_damping};
}

Made makeFeRotor(Section& section, const BuildContext& context) {
  const std::size_t problems = section.problems().list().size();
  FeRotorParameters parameters = readFeRotorParameters(section, context.simulation.rotor_speed);
  parameters.absolute_below = twistFrequency(context);
  if (section.problems().list().size() > problems) return nullptr;
  try {
    return makeFeRotorModel(parameters);
  } catch (const std::exception& error) {
    section.problem("type", std::string("a rotor whose modes exist: ") + error.what());
    return nullptr;
  }
}

}  // namespace heerk_rotor
