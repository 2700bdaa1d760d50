#include "heerk_rotor/tools/open_recorders.hpp"

#include <filesystem>
#include <stdexcept>

#include <unistd.h>

#include "heerk_rotor/tools/csv_recorder.hpp"

namespace heerk_rotor {
namespace {

std::unique_ptr<Recorder> open(const std::string& file, const RunSetup& setup, const std::vector<Signal>& signals,
                               const StateRecording& recording) {
  const CoupledSystem& system = setup.simulation->system();
  switch (outputKind(file).value()) {
    case OutputKind::kBag: return openBagRecorder(file, system, recording);
    case OutputKind::kLcm: return openLcmRecorder(file, system, recording);
    case OutputKind::kCsv: break;
  }
  if (signals.empty()) throw RecordError("this configuration publishes no signals: name some with --signals");
  return std::make_unique<CsvRecorder>(file, system, signals, setup.settings.rotor_speed, recording.grid);
}

/// The snapshot is written at the end; that its folder does not exist should not be found out then.
void checkSnapshotFolder(const std::string& file, Problems& problems) {
  if (file.empty()) return;
  const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
  if (::access(folder.c_str(), W_OK | X_OK) != 0 || std::filesystem::is_directory(file))
    problems.add({"command line", "--save-snapshot", file, "a file in a folder that can be written to"});
}

}  // namespace

MachineKind recordedKind(const CoupledSystem& system) {
  try {
    const MachineKind kind = machineKind(system);
    if (kind != MachineKind::kOther) return kind;
  } catch (const std::invalid_argument& error) {
    throw RecordError(error.what());
  }
  throw RecordError("this configuration has neither rotor quantities (no output port named lag or flap) nor those of a shaft (displacement): use .csv");
}

Recorders openRecorders(const SimulateOptions& options, RunSetup& setup, const std::vector<Signal>& signals) {
  Problems problems;
  checkSnapshotFolder(options.save_snapshot, problems);
  Recorders recorders;
  StateRecording recording;
  recording.grid = {setup.simulation->stepCount(), options.every};
  if (!options.commands.empty()) recording.command_source = CommandSource::kFile;
  for (const std::string& file : options.outputs) {
    try {
      recorders.push_back(open(file, setup, signals, recording));
    } catch (const RecordError& error) {
      problems.add({"command line", "--output", file, std::string("a file that can be recorded: ") + error.what()});
    }
  }
  if (!problems.empty()) throw ConfigurationError(problems);
  for (const auto& recorder : recorders) setup.simulation->addObserver(*recorder);
  return recorders;
}

}  // namespace heerk_rotor
