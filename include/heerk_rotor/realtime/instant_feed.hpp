#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "heerk_rotor/realtime/feed.hpp"
#include "heerk_rotor/realtime/instant.hpp"
#include "heerk_rotor/realtime/latest_value.hpp"

namespace heerk_rotor {

/// The feed of one kind of machine (RotorKind, ShaftKind): every n-th instant into rings, the newest with its shape for the
/// display, the last ones for the report of a failure. What is not finite never leaves it.
template <class Kind>
class InstantFeed final : public Feed {
 public:
  using Instant = typename Kind::Instant;
  using Picture = typename Kind::Picture;
  using Ring = SnapshotRing<Instant>;

  /// `history`: instants kept for the report of a failure. Throws std::invalid_argument as Kind::View does.
  InstantFeed(const CoupledSystem& system, std::size_t history) : view_(system), shape_view_(Kind::shapeView(system, view_)), history_(history) {}

  /// Adds a reader that gets every n-th step. A lossless one makes the step thread wait for space until `stop` is true (runs
  /// as fast as possible only). Before the run.
  void addRing(Ring& ring, std::uint64_t every) { readers_.push_back({&ring, every, nullptr}); }
  void addLosslessRing(Ring& ring, const std::atomic<bool>& stop) { readers_.push_back({&ring, 1, &stop}); }

  /// Newest instant with its shape, for readers that want no other; one reading thread.
  LatestValue<Picture>& newest() { return newest_; }

  /// Instants since the last startOver(), oldest first, up to one per kept step.
  std::vector<Instant> history() const {
    const std::uint64_t size = std::min<std::uint64_t>(history_count_, history_.size());
    std::vector<Instant> instants;
    for (std::uint64_t i = history_count_ - size; i < history_count_; ++i) instants.push_back(history_[i % history_.size()]);
    return instants;
  }

  void observe(const Sample& sample) noexcept override {
    const bool shown = shown_ && sample.step == instant_.reading.step && sample.epoch == instant_.reading.epoch;
    if (!shown) take(sample);
    if (finite_) handOut();
  }

  void startOver() noexcept override {
    Feed::startOver();
    history_count_ = 0;  // of another epoch: a failure to come has not grown out of it
  }

 private:
  struct Reader {
    Ring* ring;
    std::uint64_t every;
    const std::atomic<bool>* stop;  // lossless when set
    bool served = false;            // with instant_
  };

  void take(const Sample& sample) noexcept {
    view_.read(sample, instant_.reading);
    instant_.source = source();
    shown_ = true;
    shape_view_.read(sample, picture_.shape);
    if (!isFinite(instant_.reading) || !isFinite(picture_.shape)) {
      finite_ = false;
      return;
    }
    for (Reader& reader : readers_) reader.served = false;
    newest_.write(picture_);
    if (!history_.empty()) history_[history_count_++ % history_.size()] = instant_;
  }

  void handOut() noexcept {
    for (Reader& reader : readers_) {
      if (reader.served || (!to_everyone_ && instant_.reading.step % reader.every != 0)) continue;
      reader.served = true;
      if (reader.stop != nullptr) reader.ring->pushWaiting(instant_, *reader.stop);
      else reader.ring->push(instant_);
    }
  }

  const typename Kind::View view_;
  const typename Kind::ShapeView shape_view_;
  std::vector<Reader> readers_;
  LatestValue<Picture> newest_;
  Picture picture_;                        // last one shown
  Instant& instant_ = picture_.instant;
  bool shown_ = false;                     // instant_ holds something
  std::vector<Instant> history_;
  std::uint64_t history_count_ = 0;
};

using RotorFeed = InstantFeed<RotorKind>;
using ShaftFeed = InstantFeed<ShaftKind>;

}  // namespace heerk_rotor
