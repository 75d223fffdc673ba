#include "eval/engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace epiline::eval {

void engine_registry::add(entry new_entry) {
  if (find_design(new_entry.design) == nullptr) {
    throw std::logic_error(
        fmt::format("engine {} is for design {}, which does not exist", new_entry.name, new_entry.design));
  }
  if (find(new_entry.design, new_entry.name) != nullptr) {
    throw std::logic_error(fmt::format("engine {} of design {} is registered twice", new_entry.name, new_entry.design));
  }
  entries_.push_back(std::move(new_entry));
}

const engine_registry::entry* engine_registry::find(std::string_view design, std::string_view name) const {
  const auto found = std::ranges::find_if(
      entries_, [&](const entry& candidate) { return candidate.design == design && candidate.name == name; });
  return found == entries_.end() ? nullptr : &*found;
}

std::vector<const engine_registry::entry*> engine_registry::engines_of(std::string_view design) const {
  std::vector<const entry*> found;
  for (const auto& candidate : entries_) {
    if (candidate.design == design) found.push_back(&candidate);
  }
  return found;
}

void check_settings(const design_description& design, const match_request& request) {
  if (request.levels < 1 || request.levels > design.max_levels) {
    throw engine_error(
        fmt::format("levels is {}, but design {} takes 1 to {}", request.levels, design.name, design.max_levels));
  }
  for (const auto& parameter : design.parameters) {
    const auto found = request.parameters.find(parameter.name);
    if (found == request.parameters.end()) {
      throw engine_error(fmt::format("parameter {} of design {} has no value", parameter.name, design.name));
    }
    if (found->second < parameter.minimum || found->second > parameter.maximum) {
      throw engine_error(fmt::format("parameter {} is {}, but takes {} to {} ({})", parameter.name, found->second,
                                     parameter.minimum, parameter.maximum, parameter.meaning));
    }
  }
  for (const auto& [name, value] : request.parameters) {
    if (find_parameter(design, name) != nullptr) continue;
    std::vector<std::string_view> known;
    for (const auto& parameter : design.parameters) known.push_back(parameter.name);
    const auto closest = closest_name(name, known);
    throw engine_error(fmt::format("design {} has no parameter '{}'{}; its parameters: {}", design.name, name,
                                   closest.empty() ? "" : fmt::format(" (did you mean {}?)", closest),
                                   fmt::join(known, ", ")));
  }
}

void check_request(const design_description& design, const match_request& request) {
  check_settings(design, request);
  const auto& [left, right] = std::tie(request.left, request.right);
  if (left.width != right.width || left.height != right.height) {
    throw engine_error(fmt::format("the two images must have one size: left is {}x{}, right is {}x{}", left.width,
                                   left.height, right.width, right.height));
  }
  if (left.width < 1 || left.height < 1) throw engine_error("the images have no pixels");
  if (left.width > design.max_width || left.height > design.max_height) {
    throw engine_error(fmt::format("the images are {}x{}, but design {} takes at most {}x{}: crop or shrink them",
                                   left.width, left.height, design.name, design.max_width, design.max_height));
  }
}

}  // namespace epiline::eval
