#include "token_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace epiline::compiler_test {
namespace {

unsigned digit_value(char digit) {
  if (digit >= '0' && digit <= '9') return static_cast<unsigned>(digit - '0');
  if (digit >= 'a' && digit <= 'f') return static_cast<unsigned>(digit - 'a') + 10;
  throw std::runtime_error(fmt::format("'{}' is no hexadecimal digit", digit));
}

void place(std::span<std::uint32_t> token, const std::string& hexadecimal, const placed_field& field) {
  const unsigned digits = static_cast<unsigned>(hexadecimal.size());
  if (digits != (field.width + 3) / 4) throw std::runtime_error(fmt::format("{} has another width", field.signal));
  for (unsigned i = 0; i < digits; ++i) {
    const unsigned bits = std::min(4u, field.width - 4 * i);
    cosim::set_bits_at(token, field.offset + 4 * i, bits, digit_value(hexadecimal[digits - 1 - i]));
  }
}

}  // namespace

std::vector<recorded_port> read_token_file(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error(fmt::format("cannot read {}", file.string()));
  std::vector<recorded_port> ports;
  std::string text;
  for (std::size_t number = 1; std::getline(stream, text); ++number) {
    std::istringstream words(text);
    std::string word;
    words >> word;
    bool good = true;
    if (word == "port") {
      recorded_port& port = ports.emplace_back();
      std::string direction;
      words >> port.name >> direction >> port.kind;
      port.input = direction == "input";
      while (words >> word) {
        const std::size_t colon = word.find(':');
        good &= colon != std::string::npos;
        if (good)
          port.fields.push_back({word.substr(0, colon), static_cast<unsigned>(std::stoul(word.substr(colon + 1)))});
      }
      good &= !port.fields.empty();
    } else if (word == "token" && !ports.empty()) {
      std::vector<std::string>& token = ports.back().tokens.emplace_back();
      while (words >> word) token.push_back(word);
      good = token.size() == ports.back().fields.size();
    } else {
      good = false;
    }
    if (!good) throw std::runtime_error(fmt::format("{}:{}: not a line of a token file", file.string(), number));
  }
  return ports;
}

cosim::token_list lay_out(const recorded_port& port, const std::vector<placed_field>& fields, unsigned width) {
  std::vector<const placed_field*> places;
  for (const recorded_field& field : port.fields) {
    const auto place = std::ranges::find(fields, field.signal, &placed_field::signal);
    if (place == fields.end())
      throw std::runtime_error(fmt::format("port '{}' has no signal {}", port.name, field.signal));
    if (place->width != field.width) {
      throw std::runtime_error(
          fmt::format("port '{}': {} has {} bits, {} in C++", port.name, field.signal, place->width, field.width));
    }
    places.push_back(&*place);
  }
  if (fields.size() != port.fields.size()) {
    throw std::runtime_error(
        fmt::format("port '{}' has {} signals, {} in C++", port.name, fields.size(), port.fields.size()));
  }
  cosim::token_list result(width);
  for (const std::vector<std::string>& token : port.tokens) {
    const std::span<std::uint32_t> words = result.append();
    for (std::size_t i = 0; i < places.size(); ++i) place(words, token[i], *places[i]);
  }
  return result;
}

std::string describe(const std::vector<placed_field>& fields, const cosim::token_list& tokens, std::size_t index) {
  std::string text;
  for (const placed_field& field : fields) {
    if (!text.empty()) text += ' ';
    text += field.signal + '=';
    for (unsigned digit = (field.width + 3) / 4; digit-- > 0;) {
      text += fmt::format(
          "{:x}", cosim::bits_at(tokens[index], field.offset + 4 * digit, std::min(4u, field.width - 4 * digit)));
    }
  }
  return text;
}

std::string compare(const std::string& port, const std::vector<placed_field>& fields, const cosim::token_list& found,
                    const cosim::token_list& wanted) {
  for (std::size_t i = 0; i < std::min(found.size(), wanted.size()); ++i) {
    if (std::ranges::equal(found[i], wanted[i])) continue;
    return fmt::format("output '{}': token {} of {} is {}, native {}", port, i, wanted.size(),
                       describe(fields, found, i), describe(fields, wanted, i));
  }
  if (found.size() != wanted.size()) {
    return fmt::format("output '{}': {} tokens, native {}", port, found.size(), wanted.size());
  }
  return {};
}

}  // namespace epiline::compiler_test
