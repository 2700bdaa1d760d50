#include "heerk_rotor/tools/open_recorders.hpp"

#ifdef HEERK_WITH_ROS

#include <cmath>

#include <rosbag/bag.h>
#include <tf2_msgs/TFMessage.h>

#include "heerk_rotor/ros/conversions.hpp"
#include "heerk_rotor/tools/free_space.hpp"

namespace heerk_rotor {
namespace {

/// True once in every period of simulation time, beginning with the first call.
class SlowTopic {
 public:
  explicit SlowTopic(double rate) : rate_(rate) {}  // [Hz]
  bool due(double t) noexcept {
    const double period = std::floor(t * rate_ + 1e-6);  // the same round-off that t = k h brings along
    if (period == last_) return false;
    last_ = period;
    return true;
  }

 private:
  double rate_;
  double last_ = -1.0;
};

class BagRecorder final : public Recorder {
 public:
  BagRecorder(const std::string& file, RotorView view, const RotorRecording& recording)
      : Recorder(file, recording.grid), view_(std::move(view)), space_(file, recording.disk_reserve), bag_(std::make_unique<rosbag::Bag>()) {
    if (!space_.enough()) throw RecordError(space_.reason());
    note_.command_source = recording.command_source;
    transforms_.transforms.resize(1);
    try {
      bag_->open(file, rosbag::bagmode::Write);
    } catch (const rosbag::BagException& error) {
      throw RecordError(error.what());
    }
  }

  ~BagRecorder() override {
    try {
      close();
    } catch (const RecordError&) {  // whoever wants to know has called close()
    }
  }

  void observe(const Sample& sample) noexcept override {
    if (!space_.enough()) return fail(space_.reason());
    view_.read(sample, reading_);
    try {
      write(ros::Time(1.0 + sample.t), sample.t);
    } catch (const std::exception& error) {
      fail(error.what());
    }
  }

 private:
  void write(const ros::Time& stamp, double t) {
    toRotorState(reading_, stamp, note_, state_);
    bag_->write("/rotor/state", stamp, state_);
    toLagAngles(reading_, stamp, lag_angles_);
    bag_->write("/rotor/lag_angles", stamp, lag_angles_);
    toHubWrench(reading_, stamp, hub_wrench_);
    bag_->write("/rotor/hub_wrench", stamp, hub_wrench_);
    if (odometry_topic_.due(t)) {
      toOdometry(reading_, stamp, odometry_);
      bag_->write("/rotor/odom", stamp, odometry_);
    }
    if (transform_topic_.due(t)) {
      toTransform(reading_, stamp, transforms_.transforms.front());
      bag_->write("/tf", stamp, transforms_);
      toJointState(reading_, stamp, joints_);
      bag_->write("/joint_states", stamp, joints_);
    }
  }

  void finish() override {
    try {
      bag_->close();
    } catch (...) {
      // Its destructor would close once more, throw again and end the process: better to leak it.
      static_cast<void>(bag_.release());
      throw;
    }
  }

  RotorView view_;
  FreeSpace space_;
  std::unique_ptr<rosbag::Bag> bag_;
  PublisherNote note_;
  RotorReading reading_;
  SlowTopic odometry_topic_{100.0}, transform_topic_{60.0};
  RotorState state_;
  BladeAngles lag_angles_;
  geometry_msgs::WrenchStamped hub_wrench_;
  nav_msgs::Odometry odometry_;
  tf2_msgs::TFMessage transforms_;
  sensor_msgs::JointState joints_;
};

}  // namespace

std::unique_ptr<Recorder> openBagRecorder(const std::string& file, const CoupledSystem& system, const RotorRecording& recording) {
  return std::make_unique<BagRecorder>(file, rotorViewFor(system), recording);
}

}  // namespace heerk_rotor

#else

namespace heerk_rotor {

std::unique_ptr<Recorder> openBagRecorder(const std::string&, const CoupledSystem&, const RotorRecording&) {
  throw RecordError("this build has no rosbag: use .csv or .lcm");
}

}  // namespace heerk_rotor

#endif
