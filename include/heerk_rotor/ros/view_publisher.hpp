#pragma once
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include <ros/time.h>

#include "heerk_rotor/realtime/instant.hpp"
#include "heerk_rotor/realtime/latest_value.hpp"
#include "heerk_rotor/ros/stamp_base.hpp"

namespace heerk_rotor {

/// What is told of the newest instant at a rate of its own.
template <class Picture>
struct ViewOutput {
  int rate;  // [Hz] of real time
  std::function<void(const Picture&, const ros::Time&)> publish;
};

/// Publishes the newest instant at rates fit for eyes and navigation, per second of real time, on a thread of its own. While
/// the simulation stands still it is silent: no stamp is published twice.
template <class Picture>
class ViewPublisher {
 public:
  /// `newest` must outlive the publisher, which is its only reader.
  ViewPublisher(LatestValue<Picture>& newest, std::vector<ViewOutput<Picture>> outputs, const StampBase& stamps);
  ~ViewPublisher();

  void start();
  void stop();

 private:
  using Clock = std::chrono::steady_clock;
  struct Output {
    ViewOutput<Picture> view;
    Clock::time_point due = {};
    ros::Time published = {};  // stamp of the last one
  };
  void run();

  LatestValue<Picture>& newest_;
  std::vector<Output> outputs_;
  const StampBase stamps_;
  std::thread thread_;
  std::mutex mutex_;
  std::condition_variable stopping_;
  bool stop_ = false;  // guarded by mutex_
};

extern template class ViewPublisher<RotorPicture>;
extern template class ViewPublisher<ShaftPicture>;

}  // namespace heerk_rotor
