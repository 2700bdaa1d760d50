#pragma once
#include <Eigen/Geometry>

#include "models/rotor_runs.hpp"

namespace heerk_rotor::test {

/// From the rotating axes R_k (x outboard, y towards the leading edge, z along the shaft) to hub_link.
inline Eigen::Matrix3d fromBladeAxes(double azimuth) {
  Eigen::Matrix3d R;
  R << -std::cos(azimuth), std::sin(azimuth), 0, -std::sin(azimuth), -std::cos(azimuth), 0, 0, 0, 1;
  return R;
}

struct HubLoad {
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
};

/// Airloads of all sections at and about the hub centre, in hub_link; from section_loads and section_position of `blades` blades.
/// Pitching moments act about the undeformed axis: they are of second order already, and so the model has them.
inline HubLoad sumOfAirloads(double azimuth, const Vector& loads, const Vector& position, int blades, double precone) {
  const Eigen::Vector3d along(std::cos(precone), 0.0, std::sin(precone));
  HubLoad sum;
  for (int k = 0; k < blades; ++k) {
    const Eigen::Matrix3d R = fromBladeAxes(azimuth + 2 * M_PI * k / blades);
    for (Index j = 0; j < position.size() / (3 * blades); ++j) {
      const double *f = loads.data() + 4 * j * blades + k, *r = position.data() + 3 * j * blades + k;
      const Eigen::Vector3d force(f[0], f[blades], f[2 * blades]), arm(r[0], r[blades], r[2 * blades]);
      sum.force += R * force;
      sum.moment += R * (arm.cross(force) + f[3 * blades] * along);
    }
  }
  return sum;
}

/// Keeps whole output ports ("rotor.section_position") of every instant.
class PortRecorder : public Observer {
 public:
  PortRecorder(Simulation& simulation, const std::vector<std::string>& names) {
    for (const std::string& name : names)
      for (const CoupledSystem::Output& output : simulation.system().outputs())
        if (output.name == name) ports_.push_back({output.begin, output.size});
    if (ports_.size() != names.size()) throw std::out_of_range("no such output port");
    simulation.addObserver(*this);
  }
  void observe(const Sample& sample) noexcept override {
    std::vector<Vector> row;
    for (const auto& [begin, size] : ports_) row.push_back(sample.y.segment(begin, size));
    rows.push_back(row);
  }

  std::vector<std::vector<Vector>> rows;

 private:
  std::vector<std::pair<Index, Index>> ports_;
};

}  // namespace heerk_rotor::test
