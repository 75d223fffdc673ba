#include "eval/figures_json.hpp"

namespace epiline::eval {
namespace {

void add_shares(nlohmann::ordered_json& json, const std::string& prefix, const accuracy_counts& counts) {
  json[prefix + "correct"] = counts.correct;
  json[prefix + "accuracy"] = counts.accuracy();
  json[prefix + "bad_0.5"] = counts.bad_half_share();
  json[prefix + "bad_1"] = counts.bad_one_share();
  json[prefix + "bad_2"] = counts.bad_two_share();
  json[prefix + "bad_1_or_undefined"] = counts.bad_one_undefined_share();
  json[prefix + "average_error"] = counts.average_error();
}

void add_region(nlohmann::ordered_json& json, const std::string& prefix, const std::optional<accuracy_counts>& counts) {
  if (!counts) return;
  json[prefix + "known"] = counts->known;
  json[prefix + "defined"] = counts->defined;
  json[prefix + "coverage"] = counts->coverage();
  add_shares(json, prefix, *counts);
}

}  // namespace

nlohmann::ordered_json figures_json(const map_figures& figures) {
  nlohmann::ordered_json json;
  json["pixels"] = figures.pixels;
  json["defined"] = figures.defined;
  json["coverage"] = figures.coverage();
  if (figures.all) {
    json["known"] = figures.all->known;
    json["known_and_defined"] = figures.all->defined;
    add_shares(json, "", *figures.all);
  }
  add_region(json, "nonocc_", figures.non_occluded);
  add_region(json, "disc_", figures.near_discontinuity);
  return json;
}

}  // namespace epiline::eval
