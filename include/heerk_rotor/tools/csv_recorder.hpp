#pragma once
#include <vector>

#include "heerk_rotor/tools/recorder.hpp"
#include "heerk_rotor/tools/row_file.hpp"

namespace heerk_rotor {

/// Signals as text: a header line of cells "name [unit]", then one row per recorded instant with 17 significant digits,
/// so that every double reads back exactly. First columns: step [-], time [s], azimuth [rad].
class CsvRecorder final : public Recorder {
 public:
  /// Opens the file and writes the header. Azimuth is the output port of that name of the first subsystem that has one,
  /// otherwise rotor_speed [rad/s] * time. Throws RecordError when the file cannot be opened.
  CsvRecorder(const std::string& file, const CoupledSystem& system, const std::vector<Signal>& signals, double rotor_speed,
              RecordGrid grid);

  void observe(const Sample& sample) noexcept override { writeRow(sample.step, sample.t, sample.x, sample.y); }

  /// One row from global state and output vectors.
  void writeRow(std::uint64_t step, double t, const Vector& x, const Vector& y) noexcept;

 private:
  struct Column {
    bool state;   // an entry of x, otherwise of y
    Index index;
  };
  void finish() override;
  void failFromFile();
  void writeHeader(const std::vector<Signal>& signals);

  std::vector<Column> columns_;
  Index azimuth_ = -1;  // entry of y
  double rotor_speed_;
  RowFile rows_;
};

}  // namespace heerk_rotor
