#include "heerk_rotor/tools/csv_recorder.hpp"

#include <algorithm>
#include <cstring>

#include "heerk_rotor/tools/csv_cell.hpp"
#include "heerk_rotor/tools/number_text.hpp"

namespace heerk_rotor {
namespace {

const char* const kFixedColumns = "step [-],time [s],azimuth [rad]";

std::string cell(const Signal& signal) { return "," + csvHeaderCell(signal.name, signal.unit); }

std::size_t longestRow(const std::vector<Signal>& signals) {
  std::size_t header = std::strlen(kFixedColumns) + 1;
  for (const Signal& signal : signals) header += cell(signal).size();
  return std::max(header, (signals.size() + 3) * (kLongestNumber + 1));
}

/// Entry of y of the hub angle, or -1.
Index azimuthEntry(const CoupledSystem& system) {
  for (const CoupledSystem::Output& port : system.outputs())
    if (port.size == 1 && port.name.substr(port.name.rfind('.') + 1) == "azimuth") return port.begin;
  return -1;
}

/// Opens the file, so that a failure names it.
RowFile openRows(const std::string& file, std::size_t longest_row) {
  try {
    return RowFile(file, longest_row);
  } catch (const std::runtime_error& error) {
    throw RecordError(file + ": " + error.what());
  }
}

}  // namespace

CsvRecorder::CsvRecorder(const std::string& file, const CoupledSystem& system, const std::vector<Signal>& signals,
                         double rotor_speed, RecordGrid grid)
    : Recorder(file, grid), azimuth_(azimuthEntry(system)), rotor_speed_(rotor_speed), rows_(openRows(file, longestRow(signals))) {
  for (const Signal& signal : signals) columns_.push_back({signal.kind == Signal::Kind::kState, signal.index});
  writeHeader(signals);
}

void CsvRecorder::writeHeader(const std::vector<Signal>& signals) {
  char* end = rows_.beginRow();
  const auto append = [&end](const std::string& text) { end = std::copy(text.begin(), text.end(), end); };
  append(kFixedColumns);
  for (const Signal& signal : signals) append(cell(signal));
  append("\n");
  rows_.endRow(end);
  // At once: a reader can follow the file, and a full disk is noticed before the simulation runs.
  rows_.flush();
  if (rows_.error() != 0) throw RecordError(file() + ": " + std::strerror(rows_.error()));
}

void CsvRecorder::writeRow(std::uint64_t step, double t, const Vector& x, const Vector& y) noexcept {
  char* end = rows_.beginRow();
  if (end == nullptr) return failFromFile();
  end = writeNumber(end, step);
  *end++ = ',';
  end = writeNumber(end, t);
  *end++ = ',';
  end = writeNumber(end, azimuth_ >= 0 ? y[azimuth_] : rotor_speed_ * t);
  for (const Column& column : columns_) {
    *end++ = ',';
    end = writeNumber(end, column.state ? x[column.index] : y[column.index]);
  }
  *end++ = '\n';
  rows_.endRow(end);
}

void CsvRecorder::failFromFile() {
  fail(std::string("writing failed (") + std::strerror(rows_.error()) + "); the rows before are complete");
}

void CsvRecorder::finish() {
  if (!rows_.close()) failFromFile();
}

}  // namespace heerk_rotor
