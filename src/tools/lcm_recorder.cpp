#include "heerk_rotor/tools/open_recorders.hpp"

#ifdef HEERK_WITH_LCM

#include <cerrno>
#include <cmath>
#include <cstring>

#include <lcm/eventlog.h>

#include "heerk_rotor/lcm/conversions.hpp"
#include "heerk_rotor/tools/free_space.hpp"

namespace heerk_rotor {
namespace {

class LcmRecorder final : public Recorder {
 public:
  LcmRecorder(const std::string& file, RotorView view, const RotorRecording& recording)
      : Recorder(file, recording.grid),
        view_(std::move(view)),
        space_(file, recording.disk_reserve),
        command_source_(recording.command_source) {
    if (!space_.enough()) throw RecordError(space_.reason());
    log_ = lcm_eventlog_create(file.c_str(), "w");
    if (log_ == nullptr) throw RecordError(std::strerror(errno));
  }

  ~LcmRecorder() override {
    try {
      close();
    } catch (const RecordError&) {  // whoever wants to know has called close()
    }
  }

  void observe(const Sample& sample) noexcept override {
    if (!space_.enough()) return fail(space_.reason());
    view_.read(sample, reading_);
    toLcmState(reading_, std::llround(sample.t * 1e9), command_source_, 0, 0, message_);
    buffer_.resize(static_cast<std::size_t>(message_.getEncodedSize()));
    message_.encode(buffer_.data(), 0, static_cast<int>(buffer_.size()));
    lcm_eventlog_event_t event = {};
    event.timestamp = std::llround(sample.t * 1e6);
    event.channellen = static_cast<std::int32_t>(channel_.size());
    event.channel = channel_.data();
    event.datalen = static_cast<std::int32_t>(buffer_.size());
    event.data = buffer_.data();
    if (lcm_eventlog_write_event(log_, &event) != 0) failFromSystem();
  }

 private:
  void finish() override {
    // The library closes without looking at the result, so what is still buffered is written here.
    if (std::fflush(log_->f) != 0) failFromSystem();
    lcm_eventlog_destroy(log_);
  }

  void failFromSystem() { fail(std::string("writing failed (") + std::strerror(errno) + ")"); }

  RotorView view_;
  FreeSpace space_;
  std::string command_source_;
  std::string channel_ = "ROTOR_STATE";
  lcm_eventlog_t* log_ = nullptr;
  RotorReading reading_;
  rotor_state_t message_;
  std::vector<std::uint8_t> buffer_;
};

}  // namespace

std::unique_ptr<Recorder> openLcmRecorder(const std::string& file, const CoupledSystem& system, const RotorRecording& recording) {
  return std::make_unique<LcmRecorder>(file, rotorViewFor(system), recording);
}

}  // namespace heerk_rotor

#else

namespace heerk_rotor {

std::unique_ptr<Recorder> openLcmRecorder(const std::string&, const CoupledSystem&, const RotorRecording&) {
  throw RecordError("this build has no LCM: use .csv or .bag");
}

}  // namespace heerk_rotor

#endif
