#include "dataflow/text_pieces.hpp"

namespace epiline::dataflow {

namespace {

constexpr port_kind port_kinds[] = {port_kind::stream, port_kind::call, port_kind::result};

}  // namespace

std::string in_quotes(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      (result += '\\') += c;
    else if (c == '\n')
      result += "\\n";
    else if (c == '\t')
      result += "\\t";
    else if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7f)
      result += fmt::format("\\x{:02x}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    else
      result += c;
  }
  return result += '"';
}

std::string place_and_end(const source_location& where) {
  if (where.line == 0 && where.file == 0) return "\n";
  return fmt::format(" @{}:{}\n", where.file, where.line);
}

std::string print_port(const port& p) {
  std::string text = fmt::format("{} {} {} {}{}", p.input ? "input" : "output", name_of(p.kind), in_quotes(p.name),
                                 p.width, place_and_end(p.where));
  for (const field& f : p.fields)
    text += fmt::format("  field {} {} {}{}\n", in_quotes(f.name), in_quotes(f.signal), f.width,
                        f.is_signed ? " signed" : "");
  return text;
}

port parse_port(line_reader& line, bool input) {
  port p;
  p.input = input;
  const auto* const found = std::find_if(std::begin(port_kinds), std::end(port_kinds),
                                         [&](port_kind kind) { return line.take(name_of(kind)); });
  if (found == std::end(port_kinds)) line.unexpected("stream, call or result");
  p.kind = *found;
  p.name = line.need_string("the port's name in quotes");
  p.width = line.need_width();
  p.where = line.need_place_and_end();
  return p;
}

void append_field(line_reader& line, port& to) {
  field f;
  f.name = line.need_string("the field's name in quotes");
  f.signal = line.need_string("the signal's name in quotes");
  f.width = line.need_width();
  f.offset = to.fields.empty() ? 0 : to.fields.back().offset + to.fields.back().width;
  f.is_signed = line.take("signed");
  line.need_end();
  if (f.offset + f.width > max_width)
    line.fail(fmt::format("the fields have {} bits, expected at most {}", f.offset + f.width, max_width));
  to.fields.push_back(std::move(f));
}

}  // namespace epiline::dataflow
