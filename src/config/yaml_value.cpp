#include "heerk_rotor/config/yaml_value.hpp"

#include <charconv>
#include <cmath>
#include <locale>
#include <sstream>

namespace heerk_rotor {
namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }

std::size_t skipDigits(const std::string& text, std::size_t at) {
  while (at < text.size() && isDigit(text[at])) ++at;
  return at;
}

/// End of an optional sign and digits without a superfluous leading zero; npos when there is such a zero.
std::size_t skipWhole(const std::string& text, std::size_t at) {
  const std::size_t end = skipDigits(text, at);
  return end > at + 1 && text[at] == '0' ? std::string::npos : end;
}

/// sign? (digits (. digits?)? | . digits) ((e|E) sign? digits)?
bool isDecimal(const std::string& text) {
  std::size_t at = !text.empty() && (text[0] == '+' || text[0] == '-') ? 1 : 0;
  const std::size_t whole = skipWhole(text, at);
  if (whole == std::string::npos) return false;
  std::size_t digits = whole - at;
  at = whole;
  if (at < text.size() && text[at] == '.') {
    const std::size_t fraction = skipDigits(text, at + 1);
    digits += fraction - (at + 1);
    at = fraction;
  }
  if (digits == 0) return false;
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    ++at;
    if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
    const std::size_t exponent = skipDigits(text, at);
    if (exponent == at) return false;
    at = exponent;
  }
  return at == text.size();
}

void emit(YAML::Emitter& emitter, const YAML::Node& value) {
  switch (value.Type()) {
    case YAML::NodeType::Map:
      emitter << (value.Style() == YAML::EmitterStyle::Flow ? YAML::Flow : YAML::Block) << YAML::BeginMap;
      for (const auto& entry : value) {
        emitter << YAML::Key;
        emit(emitter, entry.first);
        emitter << YAML::Value;
        emit(emitter, entry.second);
      }
      emitter << YAML::EndMap;
      break;
    case YAML::NodeType::Sequence:
      emitter << (value.Style() == YAML::EmitterStyle::Flow ? YAML::Flow : YAML::Block) << YAML::BeginSeq;
      for (const auto& element : value) emit(emitter, element);
      emitter << YAML::EndSeq;
      break;
    case YAML::NodeType::Scalar:
      // Quotes are kept: without them "1.0" would turn from text into a number.
      if (isQuoted(value)) emitter << YAML::DoubleQuoted;
      emitter << value.Scalar();
      break;
    default:
      emitter << YAML::Null;
  }
}

}  // namespace

YAML::Node findChild(const YAML::Node& parent, const std::string& name) {
  if (parent.IsMap()) {
    for (const auto& entry : parent) {
      if (entry.first.IsScalar() && entry.first.Scalar() == name) return entry.second;
    }
  }
  if (parent.IsSequence() && !name.empty() && skipWhole(name, 0) == name.size()) {
    std::size_t index = 0;
    const auto result = std::from_chars(name.data(), name.data() + name.size(), index);
    if (result.ec == std::errc() && index < parent.size()) return parent[index];
  }
  return YAML::Node(YAML::NodeType::Undefined);
}

YAML::Node findValue(const YAML::Node& root, const std::string& dotted_key) {
  YAML::Node value(root);
  std::istringstream names(dotted_key);
  for (std::string name; std::getline(names, name, '.');) value.reset(findChild(value, name));
  return value;
}

bool isQuoted(const YAML::Node& value) { return value.IsScalar() && value.Tag() == "!"; }

bool readNumber(const YAML::Node& value, double& number) {
  if (!value.IsScalar() || isQuoted(value) || !isDecimal(value.Scalar())) return false;
  std::istringstream stream(value.Scalar());
  stream.imbue(std::locale::classic());
  double result = 0.0;
  if (!(stream >> result) || !std::isfinite(result)) return false;
  number = result;
  return true;
}

bool readInteger(const YAML::Node& value, long& number) {
  if (!value.IsScalar() || isQuoted(value)) return false;
  const std::string& text = value.Scalar();
  const std::size_t sign = !text.empty() && (text[0] == '+' || text[0] == '-') ? 1 : 0;
  if (text.size() == sign || skipWhole(text, sign) != text.size()) return false;
  const char* const begin = text.data() + (text[0] == '+' ? 1 : 0);  // from_chars takes no plus
  return std::from_chars(begin, text.data() + text.size(), number).ec == std::errc();
}

std::string asWritten(const YAML::Node& value) {
  if (!value.IsDefined()) return "(missing)";
  if (value.IsNull()) return "(empty)";
  YAML::Emitter emitter;
  if (value.IsScalar() && !isQuoted(value)) return shortened(value.Scalar());
  YAML::Node copy = YAML::Clone(value);  // the style is changed below
  if (!copy.IsScalar()) copy.SetStyle(YAML::EmitterStyle::Flow);
  emit(emitter, copy);
  return shortened(emitter.c_str());
}

std::string yamlText(const YAML::Node& root) {
  YAML::Emitter emitter;
  emit(emitter, root);
  return std::string(emitter.c_str()) + "\n";
}

std::string shortened(std::string text, std::size_t limit) {
  for (char& c : text) {
    if (c == '\n' || c == '\r' || c == '\t') c = ' ';
  }
  if (text.size() <= limit) return text;
  std::size_t end = limit - 3;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;  // never inside a UTF-8 character
  return text.substr(0, end) + "...";
}

}  // namespace heerk_rotor
