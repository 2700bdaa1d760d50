#include "heerk_rotor/ros/view_publisher.hpp"

#include <algorithm>

namespace heerk_rotor {

template <class Picture>
ViewPublisher<Picture>::ViewPublisher(LatestValue<Picture>& newest, std::vector<ViewOutput<Picture>> outputs, const StampBase& stamps)
    : newest_(newest), stamps_(stamps) {
  for (ViewOutput<Picture>& output : outputs) outputs_.push_back({std::move(output), {}, {}});
}

template <class Picture>
ViewPublisher<Picture>::~ViewPublisher() {
  stop();
}

template <class Picture>
void ViewPublisher<Picture>::start() {
  thread_ = std::thread([this] { run(); });
}

template <class Picture>
void ViewPublisher<Picture>::stop() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  stopping_.notify_all();
  if (thread_.joinable()) thread_.join();
}

template <class Picture>
void ViewPublisher<Picture>::run() {
  Picture picture;
  bool have = false;
  std::unique_lock<std::mutex> lock(mutex_);
  while (!stop_) {
    have |= newest_.read(picture);
    const Clock::time_point now = Clock::now();
    const ros::Time stamp = stamps_.at(picture.instant.reading.sim_time);
    Clock::time_point next = now + std::chrono::seconds(1);
    for (Output& output : outputs_) {
      if (output.due <= now) {
        if (have && stamp > output.published) {
          output.view.publish(picture, stamp);
          output.published = stamp;
        }
        const auto period = std::chrono::duration_cast<Clock::duration>(std::chrono::seconds(1)) / output.view.rate;
        output.due = std::max(output.due + period, now);  // what was missed is not made up for
      }
      next = std::min(next, output.due);
    }
    stopping_.wait_until(lock, next, [this] { return stop_; });
  }
}

template class ViewPublisher<RotorPicture>;
template class ViewPublisher<ShaftPicture>;

}  // namespace heerk_rotor
