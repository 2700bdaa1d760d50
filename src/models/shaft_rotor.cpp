#include "heerk_rotor/models/shaft_rotor.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

#include "shaft_form.hpp"

namespace heerk_rotor {
namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

enum DriveEntry { kDriveAngle, kDriveRate, kDriveAcceleration, kDriveSize };

/// x' += S x for the kinds the forms have.
struct AddStiff {
  const In& x;
  Out& xdot;
  void operator()(const PairStiff& part) const noexcept {
    const auto m = static_cast<Index>(part.blocks.size());
    for (Index i = 0; i < m; ++i) {
      const Eigen::Matrix2d& block = part.blocks[static_cast<std::size_t>(i)];
      xdot[i] += block(0, 0) * x[i] + block(0, 1) * x[m + i];
      xdot[m + i] += block(1, 0) * x[i] + block(1, 1) * x[m + i];
    }
  }
  void operator()(const SecondOrderStiff& part) const noexcept {
    const Index m = part.stiffness.rows();
    xdot.head(m) += x.tail(m);
    xdot.tail(m).noalias() -= part.stiffness * x.head(m);
    xdot.tail(m).noalias() -= part.damping * x.tail(m);
  }
  template <class Other>
  void operator()(const Other&) const noexcept {}
};

class ShaftRotor : public SubsystemModel {
 public:
  ShaftRotor(const ShaftRotorParameters& p, const ShaftMatrices& shaft, ShaftForm form);

  std::vector<State> states() const override { return form_.states; }
  std::vector<InputPort> inputs() const override;
  std::vector<OutputPort> outputs() const override;
  StiffPart stiffPart() const override { return form_.S; }
  bool providesRemainder() const override { return true; }
  void evalOutput(Index port, double t, const In& x, const In& u, Out y) noexcept override;
  void evalDerivatives(double t, const In& x, const In& u, Out xdot) noexcept override;
  void evalRemainder(double t, const In& x, const In& u, Out remainder) noexcept override;
  void completeInitialState(const In&, Out x) const override { x += form_.start; }
  const NarrowForm* narrowForm() const override { return narrow_.C.rows() > 0 ? &narrow_ : nullptr; }
  bool narrowOutput(Index port) const override;
  void evalNarrowOutput(Index port, double t, const In& z, const In& u, Out y) noexcept override;
  bool evalNarrowRemainder(double t, const In& z, const In& u, Out r) noexcept override;

 private:
  enum class Kind { kRows, kAzimuth, kSpeed, kEnergy, kDissipation, kUnbalancePower };
  struct Port {
    Kind kind;
    OutputPort declaration;
    Rows rows;           // (size x N), kRows only
    Index z_begin;       // of a journal's motion: its place in z
  };
  /// (omega^2 - i omega') e^{i psi}, of which the unbalance columns take real and imaginary part; `less` times the phasor taken off.
  struct Rotating {
    double re, im;
  };
  Rotating rotating(double t, const In& x, const In& u, double less) const noexcept;

  /// A port whose entries are rows of (q, q') each; the names take turns with unit and unit per second.
  void addRows(OutputPort declaration, const Matrix& of_motion, Index z_begin = -1);
  void addScalar(Kind kind, OutputPort declaration);
  void addPorts(const ShaftMatrices& shaft);

  ShaftRotorParameters p_;
  ShaftForm form_;
  std::vector<Port> ports_;
  Matrix journal_force_;      // (N x 2 journals) x' per force
  Rows film_rates_;           // (2 x N) velocity of the first journal
  Matrix unbalance_force_;    // (N x 2)
  Rows unbalance_rates_;      // (2 x N) velocity that the unbalance columns work on
  Matrix speed_deviation_;    // (N x N) gyroscopic term of one rad/s more than nominal
  Rows rates_;                // (n x N) q'
  Matrix damping_;            // (n x n) C
  NarrowForm narrow_;         // z: motion of each journal; r: force on each, then the unbalance where S does not hold it
  bool unbalance_inside_;
  Vector rate_, load_, energy_;  // scratch
};

ShaftRotor::ShaftRotor(const ShaftRotorParameters& p, const ShaftMatrices& shaft, ShaftForm form) : p_(p), form_(std::move(form)), unbalance_inside_(form_.phasor_cos >= 0) {
  const Index n = shaft.size(), journals = static_cast<Index>(p.journals.size());
  rates_ = form_.observe.bottomRows(n);
  damping_ = shaft.C.cast<double>();
  const Matrix unbalance = shaft.unbalance.cast<double>();
  unbalance_force_ = form_.force * unbalance;
  unbalance_rates_ = unbalance.transpose() * rates_;
  speed_deviation_ = form_.force * shaft.G.cast<double>() * rates_;
  journal_force_.resize(form_.force.rows(), 2 * journals);
  for (Index j = 0; j < journals; ++j) {
    const Index row = shaftRow(p.journals[static_cast<std::size_t>(j)], kShaftX);
    journal_force_.middleCols(2 * j, 2) = form_.force.middleCols(row, 2);
    if (j == 0) film_rates_ = rates_.middleRows(row, 2);
  }
  rate_.setZero(n);
  load_.setZero(n);
  energy_.setZero(2 * n);
  addPorts(shaft);

  if (journals == 0) return;
  narrow_.C.resize(4 * journals, form_.force.rows());
  for (const Port& port : ports_)
    if (port.z_begin >= 0) narrow_.C.middleRows(port.z_begin, 4) = port.rows;
  narrow_.B.resize(form_.force.rows(), 2 * journals + (unbalance_inside_ ? 0 : 2));
  narrow_.B.leftCols(2 * journals) = journal_force_;
  if (!unbalance_inside_) narrow_.B.rightCols(2) = unbalance_force_;
}

void ShaftRotor::addRows(OutputPort declaration, const Matrix& of_motion, Index z_begin) {
  declaration.size = of_motion.rows();
  if (declaration.size == 0) return;
  ports_.push_back({Kind::kRows, std::move(declaration), of_motion * form_.observe, z_begin});
}

void ShaftRotor::addScalar(Kind kind, OutputPort declaration) { ports_.push_back({kind, std::move(declaration), {}, -1}); }

void ShaftRotor::addPorts(const ShaftMatrices& shaft) {
  const Index n = shaft.size();
  const auto discs = static_cast<Index>(p_.shaft.discs.size()), bearings = static_cast<Index>(p_.shaft.bearings.size());
  const auto place = [&](const auto& parts, Index i) { return shaftRow(parts[static_cast<std::size_t>(i)].node, kShaftX); };
  const auto name = [](const char* what, Index number, Index axis, const char* after = "") { return what + std::to_string(number) + (axis == 0 ? "_x" : "_y") + after; };

  OutputPort displacement{"displacement", 0, "m", "displacement of each disc from its static position", {}, 1e-5, {}, true};
  OutputPort velocity{"disc_velocity", 0, "m/s", "velocity of each disc", {}, 1e-2};
  Matrix at = Matrix::Zero(2 * discs, 2 * n), moving = at;
  for (Index i = 0; i < discs; ++i)
    for (Index axis : {0, 1}) {
      at(2 * i + axis, place(p_.shaft.discs, i) + axis) = 1.0;
      moving(2 * i + axis, n + place(p_.shaft.discs, i) + axis) = 1.0;
      displacement.entries.push_back(name("disc_", i + 1, axis));
      velocity.entries.push_back(name("disc_", i + 1, axis, "_rate"));
    }
  addRows(displacement, at);
  addRows(velocity, moving);

  for (std::size_t j = 0; j < p_.journals.size(); ++j) {
    const std::string number = j == 0 ? "" : "_" + std::to_string(j + 1), who = "journal" + number;
    const Index row = shaftRow(p_.journals[j], kShaftX);
    Matrix motion = Matrix::Zero(4, 2 * n);
    for (Index axis : {0, 1}) {
      motion(axis, row + axis) = 1.0;
      motion(2 + axis, n + row + axis) = 1.0;
    }
    addRows({"journal_motion" + number, 0, "m, m/s", "displacement of the journal from its static position along x and y, and its velocity", {}, 1e-5,
             {who + "_x", who + "_y", who + "_x_rate", who + "_y_rate"}, true, {"m", "m", "m/s", "m/s"}}, motion, 4 * static_cast<Index>(j));
  }

  OutputPort force{"bearing_force", 0, "N", "force of each bearing on the shaft, without its static part", {}, 100.0, {}, true};
  Matrix bearing = Matrix::Zero(2 * bearings, 2 * n);
  for (Index i = 0; i < bearings; ++i) {
    const ShaftBearing& b = p_.shaft.bearings[static_cast<std::size_t>(i)];
    for (Index axis : {0, 1}) {
      bearing(2 * i + axis, place(p_.shaft.bearings, i) + axis) = axis == 0 ? -b.stiffness_x : -b.stiffness_y;
      bearing(2 * i + axis, n + place(p_.shaft.bearings, i) + axis) = axis == 0 ? -b.damping_x : -b.damping_y;
      force.entries.push_back(name("bearing_", i + 1, axis));
    }
  }
  addRows(force, bearing);

  OutputPort nodes{"node_displacement", 0, "m", "displacement of each node from its static position", {}, 1e-5};
  Matrix every = Matrix::Zero(2 * p_.shaft.nodes(), 2 * n);
  for (int k = 0; k < p_.shaft.nodes(); ++k)
    for (Index axis : {0, 1}) {
      every(2 * k + axis, shaftRow(k, kShaftX) + axis) = 1.0;
      nodes.entries.push_back(name("node_", k, axis));
    }
  addRows(nodes, every);

  addScalar(Kind::kAzimuth, {"azimuth", 1, "rad", "angle the rotor has turned", {"drive"}, 1.0});
  addScalar(Kind::kSpeed, {"rotor_speed", 1, "rad/s", "speed of the rotor", {"drive"}, p_.rotor_speed});
  addScalar(Kind::kEnergy, {"energy", 1, "J", "kinetic and elastic energy of shaft, discs and bearings, without that of the rotation", {}, 1e-2});
  addScalar(Kind::kDissipation, {"dissipated_power", 1, "W", "power that the damping of shaft and bearings takes", {}, 1.0});
  addScalar(Kind::kUnbalancePower, {"unbalance_power", 1, "W", "power of the unbalance forces on the lateral motion", {"drive"}, 1.0});
}

std::vector<InputPort> ShaftRotor::inputs() const {
  std::vector<InputPort> list{{"drive", kDriveSize, "rad, rad/s, rad/s^2", "angle, rate and acceleration of the drive relative to Omega t; nothing connected: constant nominal speed", Unconnected::kDefault}};
  for (std::size_t j = 0; j < p_.journals.size(); ++j)
    list.push_back({"journal_force" + (j == 0 ? "" : "_" + std::to_string(j + 1)), 2, "N", "force on the journal along x and y", Unconnected::kDefault});
  return list;
}

std::vector<OutputPort> ShaftRotor::outputs() const {
  std::vector<OutputPort> list;
  for (const Port& port : ports_) list.push_back(port.declaration);
  return list;
}

ShaftRotor::Rotating ShaftRotor::rotating(double t, const In& x, const In& u, double less) const noexcept {
  const double omega = p_.rotor_speed + u[kDriveRate], square = omega * omega;
  const double c = unbalance_inside_ ? x[form_.phasor_cos] : std::cos(p_.rotor_speed * t);
  const double s = unbalance_inside_ ? x[form_.phasor_sin] : std::sin(p_.rotor_speed * t);
  const double turn_c = std::cos(u[kDriveAngle]), turn_s = std::sin(u[kDriveAngle]);
  const double re = square * turn_c + u[kDriveAcceleration] * turn_s - less;
  const double im = square * turn_s - u[kDriveAcceleration] * turn_c;
  return {re * c - im * s, re * s + im * c};
}

void ShaftRotor::evalOutput(Index number, double t, const In& x, const In& u, Out y) noexcept {
  const Port& port = ports_[static_cast<std::size_t>(number)];
  switch (port.kind) {
    case Kind::kRows: y.noalias() = port.rows * x; break;
    case Kind::kAzimuth: y[0] = p_.rotor_speed * t + u[kDriveAngle]; break;
    case Kind::kSpeed: y[0] = p_.rotor_speed + u[kDriveRate]; break;
    case Kind::kEnergy:
      energy_.noalias() = form_.energy * x;
      y[0] = 0.5 * energy_.squaredNorm();
      break;
    case Kind::kDissipation:
      rate_.noalias() = rates_ * x;
      load_.noalias() = damping_ * rate_;
      y[0] = rate_.dot(load_);
      break;
    case Kind::kUnbalancePower: {
      const Rotating force = rotating(t, x, u, 0.0);
      y[0] = unbalance_rates_.row(0).dot(x) * force.re + unbalance_rates_.row(1).dot(x) * force.im;
      break;
    }
  }
}

bool ShaftRotor::narrowOutput(Index port) const {
  const Port& p = ports_[static_cast<std::size_t>(port)];
  return p.z_begin >= 0 || p.kind == Kind::kAzimuth || p.kind == Kind::kSpeed;
}

void ShaftRotor::evalNarrowOutput(Index port, double t, const In& z, const In& u, Out y) noexcept {
  const Index z_begin = ports_[static_cast<std::size_t>(port)].z_begin;
  if (z_begin < 0) return evalOutput(port, t, z, u, y);  // angle and speed, which do not read the state
  for (Index i = 0; i < 4; ++i) y[i] = z[z_begin + i];
}

bool ShaftRotor::evalNarrowRemainder(double t, const In& z, const In& u, Out r) noexcept {
  const bool deviates = u[kDriveAngle] != 0.0 || u[kDriveAcceleration] != 0.0;
  if (u[kDriveRate] != 0.0 || (unbalance_inside_ && deviates)) return false;
  for (Index j = 0; j < journal_force_.cols(); ++j) r[j] = u[kDriveSize + j];
  for (Index i : {0, 1}) r[i] += p_.linearised_film_damping * z[2 + i];
  if (unbalance_inside_) return true;
  const Rotating force = rotating(t, z, u, 0.0);
  r[journal_force_.cols()] = force.re;
  r[journal_force_.cols() + 1] = force.im;
  return true;
}

void ShaftRotor::evalRemainder(double t, const In& x, const In& u, Out remainder) noexcept {
  if (journal_force_.cols() == 0) remainder.setZero();
  for (Index j = 0; j < journal_force_.cols(); j += 2) {
    double force_x = u[kDriveSize + j], force_y = u[kDriveSize + j + 1];
    if (j == 0 && p_.linearised_film_damping > 0.0) {
      force_x += p_.linearised_film_damping * film_rates_.row(0).dot(x);
      force_y += p_.linearised_film_damping * film_rates_.row(1).dot(x);
    }
    if (j == 0) remainder = journal_force_.col(0) * force_x + journal_force_.col(1) * force_y;
    else remainder += journal_force_.col(j) * force_x + journal_force_.col(j + 1) * force_y;
  }
  const bool deviates = u[kDriveAngle] != 0.0 || u[kDriveRate] != 0.0 || u[kDriveAcceleration] != 0.0;
  if (unbalance_inside_ && !deviates) return;
  const Rotating force = rotating(t, x, u, unbalance_inside_ ? p_.rotor_speed * p_.rotor_speed : 0.0);
  remainder += unbalance_force_.col(0) * force.re + unbalance_force_.col(1) * force.im;
  if (u[kDriveRate] != 0.0) remainder.noalias() += speed_deviation_ * (u[kDriveRate] * x);
}

void ShaftRotor::evalDerivatives(double t, const In& x, const In& u, Out xdot) noexcept {
  evalRemainder(t, x, u, xdot);
  std::visit(AddStiff{x, xdot}, form_.S);
}

}  // namespace

std::unique_ptr<SubsystemModel> makeShaftRotorModel(const ShaftRotorParameters& p) {
  const ShaftMatrices shaft = assembleShaft(p.shaft);
  ShaftMatrices stiff = shaft;  // what S holds: the shaft, and the damping it is lent
  if (!p.journals.empty())
    for (const ShaftDof dof : {kShaftX, kShaftY}) {
      const Eigen::Index row = shaftRow(p.journals.front(), dof);
      stiff.C(row, row) += p.linearised_film_damping;
    }
  return std::make_unique<ShaftRotor>(p, shaft, p.modal ? modalShaftForm(stiff, p.rotor_speed, p.unbalance_in_exponential) : physicalShaftForm(stiff, p.rotor_speed));
}

}  // namespace heerk_rotor
