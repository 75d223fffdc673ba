#pragma once
// Reading JSON files that people write: every complaint names the file and the place in it, as `[3].levels`.

#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace epiline::eval {

/// The contents of a file. Throws file_error when it cannot be read or is not JSON; `kind` says what it should be.
[[nodiscard]] nlohmann::json read_json(const std::filesystem::path& file, std::string_view kind);

/// A value in a JSON file and its place there. The file's name and the value must outlive it.
class json_place {
 public:
  json_place(const std::filesystem::path& file, const nlohmann::json& value, std::string path = "")
      : file_(&file), value_(&value), path_(std::move(path)) {}

  [[nodiscard]] const nlohmann::json& value() const { return *value_; }
  [[nodiscard]] bool has(const std::string& name) const { return value_->contains(name); }
  [[nodiscard]] json_place item(std::size_t index) const;

  /// Throws file_error when there is no such field.
  [[nodiscard]] json_place field(const std::string& name) const;

  /// Throws file_error.
  [[noreturn]] void fail(std::string_view what) const;

  /// Throws file_error unless `holds`: "expected KIND, found VALUE".
  void require(bool holds, std::string_view kind) const;
  void require_object(std::initializer_list<std::string_view> known_fields) const;
  [[nodiscard]] std::string text() const;
  [[nodiscard]] double positive_number(std::string_view kind) const;
  [[nodiscard]] int whole_number(int minimum, int maximum) const;

 private:
  const std::filesystem::path* file_;
  const nlohmann::json* value_;
  std::string path_;
};

}  // namespace epiline::eval
