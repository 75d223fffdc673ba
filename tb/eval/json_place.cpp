#include "eval/json_place.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <vector>

#include "eval/designs.hpp"
#include "eval/output_file.hpp"

namespace epiline::eval {

using nlohmann::json;

json read_json(const std::filesystem::path& file, std::string_view kind) {
  if (std::filesystem::is_directory(file)) {
    throw file_error(fmt::format("{} is a directory; name {}, a JSON file", file.string(), kind));
  }
  std::ifstream stream(file);
  if (!stream) throw file_error(fmt::format("cannot open {}, {}; check the path", file.string(), kind));
  try {
    return json::parse(stream);
  } catch (const json::exception& error) {
    throw file_error(fmt::format("{}, {}, is not valid JSON: {}", file.string(), kind, error.what()));
  }
}

json_place json_place::item(std::size_t index) const {
  return {*file_, value_->at(index), fmt::format("{}[{}]", path_, index)};
}

json_place json_place::field(const std::string& name) const {
  if (!has(name)) fail(fmt::format("the field \"{}\" is missing", name));
  return {*file_, value_->at(name), path_.empty() ? name : fmt::format("{}.{}", path_, name)};
}

void json_place::fail(std::string_view what) const {
  throw file_error(fmt::format("{}: {}{}{}", file_->string(), path_, path_.empty() ? "" : ": ", what));
}

void json_place::require(bool holds, std::string_view kind) const {
  if (holds) return;
  const std::string found = value_->dump(-1, ' ', false, json::error_handler_t::replace);
  fail(fmt::format("expected {}, found {}{}", kind, found.substr(0, 60), found.size() > 60 ? "..." : ""));
}

void json_place::require_object(std::initializer_list<std::string_view> known_fields) const {
  require(value_->is_object(), "an object");
  const std::vector<std::string_view> known(known_fields);
  for (const auto& [name, value] : value_->items()) {
    if (std::ranges::find(known, name) != known.end()) continue;
    const auto closest = closest_name(name, known);
    field(name).fail(fmt::format("unknown field{}; known: {}",
                                 closest.empty() ? "" : fmt::format(" (did you mean {}?)", closest),
                                 fmt::join(known, ", ")));
  }
}

std::string json_place::text() const {
  require(value_->is_string() && !value_->get_ref<const std::string&>().empty(), "a text that is not empty");
  return value_->get<std::string>();
}

double json_place::positive_number(std::string_view kind) const {
  require(value_->is_number(), kind);
  require(*value_ > 0, kind);
  return value_->get<double>();
}

int json_place::whole_number(int minimum, int maximum) const {
  const std::string kind = fmt::format("a whole number from {} to {}", minimum, maximum);
  require(value_->is_number_integer(), kind);
  require(*value_ >= minimum && *value_ <= maximum, kind);
  return value_->get<int>();
}

}  // namespace epiline::eval
