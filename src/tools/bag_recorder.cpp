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

/// What a bag holds of one kind of machine.
class BagTopics {
 public:
  virtual ~BagTopics() = default;
  /// May throw.
  virtual void write(const Sample& sample, const ros::Time& stamp, rosbag::Bag& bag) = 0;
};

class RotorTopics final : public BagTopics {
 public:
  RotorTopics(const CoupledSystem& system, CommandSource source) : view_(system) {
    instant_.source = source;
    transforms_.transforms.resize(1);
  }

  void write(const Sample& sample, const ros::Time& stamp, rosbag::Bag& bag) override {
    const RotorReading& reading = instant_.reading;
    view_.read(sample, instant_.reading);
    toRotorState(instant_, stamp, PublisherNote(), state_);
    bag.write("/rotor/state", stamp, state_);
    toLagAngles(reading, stamp, lag_angles_);
    bag.write("/rotor/lag_angles", stamp, lag_angles_);
    toHubWrench(reading, stamp, hub_wrench_);
    bag.write("/rotor/hub_wrench", stamp, hub_wrench_);
    if (odometry_topic_.due(sample.t)) {
      toOdometry(reading, stamp, odometry_);
      bag.write("/rotor/odom", stamp, odometry_);
    }
    if (transform_topic_.due(sample.t)) {
      toTransform(reading, stamp, transforms_.transforms.front());
      bag.write("/tf", stamp, transforms_);
      toJointState(reading, stamp, joints_);
      bag.write("/joint_states", stamp, joints_);
    }
  }

 private:
  const RotorView view_;
  RotorInstant instant_;
  SlowTopic odometry_topic_{100.0}, transform_topic_{60.0};
  RotorState state_;
  BladeAngles lag_angles_;
  geometry_msgs::WrenchStamped hub_wrench_;
  nav_msgs::Odometry odometry_;
  tf2_msgs::TFMessage transforms_;
  sensor_msgs::JointState joints_;
};

class ShaftTopics final : public BagTopics {
 public:
  explicit ShaftTopics(const CoupledSystem& system) : view_(system) {}

  void write(const Sample& sample, const ros::Time& stamp, rosbag::Bag& bag) override {
    view_.read(sample, instant_.reading);
    toShaftState(instant_, stamp, PublisherNote(), state_);
    bag.write("/shaft/state", stamp, state_);
  }

 private:
  const ShaftView view_;
  ShaftInstant instant_;
  ShaftState state_;
};

std::unique_ptr<BagTopics> topicsOf(const CoupledSystem& system, CommandSource source) {
  if (recordedKind(system) == MachineKind::kShaft) return std::make_unique<ShaftTopics>(system);
  return std::make_unique<RotorTopics>(system, source);
}

class BagRecorder final : public Recorder {
 public:
  BagRecorder(const std::string& file, std::unique_ptr<BagTopics> topics, const StateRecording& recording)
      : Recorder(file, recording.grid), topics_(std::move(topics)), space_(file, recording.disk_reserve), bag_(std::make_unique<rosbag::Bag>()) {
    if (!space_.enough()) throw RecordError(space_.reason());
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
    try {
      topics_->write(sample, ros::Time(1.0 + sample.t), *bag_);
    } catch (const std::exception& error) {
      fail(error.what());
    }
  }

 private:
  void finish() override {
    try {
      bag_->close();
    } catch (...) {
      // Its destructor would close once more, throw again and end the process: better to leak it.
      static_cast<void>(bag_.release());
      throw;
    }
  }

  const std::unique_ptr<BagTopics> topics_;
  FreeSpace space_;
  std::unique_ptr<rosbag::Bag> bag_;
};

}  // namespace

std::unique_ptr<Recorder> openBagRecorder(const std::string& file, const CoupledSystem& system, const StateRecording& recording) {
  return std::make_unique<BagRecorder>(file, topicsOf(system, recording.command_source), recording);
}

}  // namespace heerk_rotor

#else

namespace heerk_rotor {

std::unique_ptr<Recorder> openBagRecorder(const std::string&, const CoupledSystem&, const StateRecording&) {
  throw RecordError("this build has no rosbag: use .csv or .lcm");
}

}  // namespace heerk_rotor

#endif
