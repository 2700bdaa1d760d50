#include "heerk_rotor/tools/open_recorders.hpp"

#ifdef HEERK_WITH_LCM

#include <cerrno>
#include <cstring>

#include <lcm/eventlog.h>

#include "heerk_rotor/lcm/lcm_log_packer.hpp"
#include "heerk_rotor/tools/free_space.hpp"

namespace heerk_rotor {
namespace {

template <class Kind>
class LcmRecorder final : public Recorder {
 public:
  LcmRecorder(const std::string& file, const CoupledSystem& system, const StateRecording& recording)
      : Recorder(file, recording.grid), view_(system), space_(file, recording.disk_reserve), packer_(recording.grid.every) {
    instant_.source = recording.command_source;
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
    view_.read(sample, instant_.reading);
    packer_.add(instant_, {lcmStamp(0, sample.t), 0, 0}, write_);
  }

 private:
  bool write(const LcmPackedEvent& packed) {
    lcm_eventlog_event_t event = {};
    event.timestamp = packed.stamp / 1000;
    event.channellen = static_cast<std::int32_t>(std::strlen(packed.channel));
    event.channel = const_cast<char*>(packed.channel);  // both are only read
    event.datalen = static_cast<std::int32_t>(packed.data.size());
    event.data = const_cast<std::uint8_t*>(packed.data.data());
    if (lcm_eventlog_write_event(log_, &event) == 0) return true;
    failFromSystem();
    return false;
  }

  void finish() override {
    packer_.flush(write_);
    // The library closes without looking at the result, so what is still buffered is written here.
    if (std::fflush(log_->f) != 0) failFromSystem();
    lcm_eventlog_destroy(log_);
  }

  void failFromSystem() { fail(std::string("writing failed (") + std::strerror(errno) + ")"); }

  const typename Kind::View view_;
  FreeSpace space_;
  LcmLogPacker<typename Kind::Instant> packer_;
  const LcmEventWriter write_ = [this](const LcmPackedEvent& event) { return write(event); };
  lcm_eventlog_t* log_ = nullptr;
  typename Kind::Instant instant_;
};

}  // namespace

std::unique_ptr<Recorder> openLcmRecorder(const std::string& file, const CoupledSystem& system, const StateRecording& recording) {
  if (recordedKind(system) == MachineKind::kShaft) return std::make_unique<LcmRecorder<ShaftKind>>(file, system, recording);
  return std::make_unique<LcmRecorder<RotorKind>>(file, system, recording);
}

}  // namespace heerk_rotor

#else

namespace heerk_rotor {

std::unique_ptr<Recorder> openLcmRecorder(const std::string&, const CoupledSystem&, const StateRecording&) {
  throw RecordError("this build has no LCM: use .csv or .bag");
}

}  // namespace heerk_rotor

#endif
