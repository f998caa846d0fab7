#include "experiment/study_file.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <numeric>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiment/methods.hpp"
#include "incognita/io/input_error.hpp"
#include "incognita/io/read_file.hpp"
#include "support/study_plans.hpp"

namespace experiment {
namespace {

/// Reads one study. What is wrong is said with the line that it is on.
class StudyReader {
 public:
  StudyReader(std::filesystem::path file, std::filesystem::path data, std::filesystem::path shipped)
      : file_(std::move(file)), data_(std::move(data)), shipped_(std::move(shipped)) {}

  [[nodiscard]] Study read() {
    const toml::table root = with_what_it_is_like(parsed(file_));
    allow(root, {"title", "defaults", "map", "method", "trials", "claim", "report"});
    study_.file = file_;
    study_.title = text(root, root, "title");
    const toml::table* defaults = nullptr;
    if (const toml::node* node = root.get("defaults")) {
      defaults = node->as_table();
      if (defaults == nullptr) fail(*node, "defaults is not a table");
      for (auto&& [key, value] : *defaults) {
        require_setting(key, {});
        require_not_of_methods(key);
      }
    }
    const std::vector<const toml::table*> maps = tables(root, "map");
    const std::vector<const toml::table*> methods = tables(root, "method");
    for (const toml::table* map : maps) add_map(*map);
    for (const toml::table* method : methods) add_method(*method);
    for (const toml::table* map : maps) {
      for (const toml::table* method : methods) add_settings(defaults, *map, *method);
    }
    for (const toml::table* group : tables(root, "trials")) add_trials(*group);
    if (root.contains("claim")) {
      for (const toml::table* claim : tables(root, "claim")) add_claim(*claim);
    }
    if (const toml::node* node = root.get("report")) {
      const toml::table* report = node->as_table();
      if (report == nullptr) fail(*node, "report is not a table");
      allow(*report, {"tables", "curves"});
      study_.tables = metrics(*report, "tables", table_metrics());
      study_.curves = metrics(*report, "curves", curve_metrics());
      const bool shows_corridors = std::find(study_.tables.begin(), study_.tables.end(), "corridor_share") != study_.tables.end();
      const auto has_corridors = [](const StudyMap& map) { return map.corridor_max_m.has_value(); };
      if (shows_corridors && std::none_of(study_.maps.begin(), study_.maps.end(), has_corridors)) {
        fail(*report->get("tables"), "corridor_share is measured on no map, as none has a corridor_max_m");
      }
    }
    return study_;
  }

  /// What a finished mission is measured by, and what is recorded as it goes on.
  [[nodiscard]] static const std::vector<std::string>& table_metrics() {
    static const std::vector<std::string> all{
        "translation_rmse_m", "translation_mae_m", "heading_rmse_rad", "nees", "map_error", "bits_per_step", "explored_fraction",
        "explored_share_of_time", "end_s", "time_to_90_percent_s", "distance_m", "decisions", "collisions", "corridor_share"};
    return all;
  }
  [[nodiscard]] static const std::vector<std::string>& curve_metrics() {
    static const std::vector<std::string> all{"explored_fraction", "information_bits", "position_error_m", "three_sigma_m", "distance_m"};
    return all;
  }

 private:
  [[noreturn]] void fail(const toml::node& where, const std::string& problem) const { fail(where.source(), problem); }
  [[noreturn]] void fail(const toml::source_region& where, const std::string& problem) const { throw incognita::InputError(place(where), problem); }

  /// File and line: parts of a study may be of the one that it is like.
  [[nodiscard]] std::string place(const toml::source_region& where) const {
    return (where.path ? *where.path : file_.string()) + ':' + std::to_string(where.begin.line);
  }

  [[nodiscard]] toml::table parsed(const std::filesystem::path& file) const {
    try {
      return toml::parse(incognita::read_file(file, 1'000'000), file.string());
    } catch (const toml::parse_error& problem) {
      fail(problem.source(), std::string("is not TOML: ") + std::string(problem.description()));
    }
  }

  /// Each part that a study lacks is that of the one that it is like, beside it or shipped.
  [[nodiscard]] toml::table with_what_it_is_like(toml::table own) const {
    if (!own.contains("like")) return own;
    const std::string like = text(own, "like");
    std::error_code error;
    std::filesystem::path file = file_.parent_path() / (like + ".toml");
    if (!std::filesystem::is_regular_file(file, error)) file = shipped_ / (like + ".toml");
    if (!std::filesystem::is_regular_file(file, error)) fail(*own.get("like"), "there is no study " + quoted(like) + " beside this one, nor is one shipped");
    toml::table whole = parsed(file);
    if (whole.contains("like")) fail(*own.get("like"), "like names a study that is like another itself");
    own.erase("like");
    for (auto&& [key, value] : own) {
      const std::string_view name = key.str();
      value.visit([&whole, name](const auto& node) { whole.insert_or_assign(name, node); });
    }
    return whole;
  }

  static std::string quoted(std::string_view word) { return incognita::shown(word); }

  template <class Words>
  static std::string list_of(const Words& words) {
    std::string list;
    for (const auto& word : words) {
      if (word.empty()) continue;
      list += list.empty() ? "" : ", ";
      list += word;
    }
    return list;
  }

  void allow(const toml::table& table, std::initializer_list<std::string_view> keys) const {
    for (auto&& [key, value] : table) {
      if (std::find(keys.begin(), keys.end(), key.str()) == keys.end()) {
        fail(key.source(), "there is no key " + quoted(key.str()) + " here, but only " + list_of(keys));
      }
    }
  }

  [[nodiscard]] std::vector<const toml::table*> tables(const toml::table& root, const std::string& name) const {
    std::vector<const toml::table*> all;
    const toml::node* node = root.get(name);
    const toml::array* array = node == nullptr ? nullptr : node->as_array();
    if (array == nullptr || array->empty()) fail(node == nullptr ? root.source() : node->source(), "has no [[" + name + "]]");
    for (const toml::node& element : *array) {
      if (!element.is_table()) fail(element, name + " is not a list of tables, [[" + name + "]]");
      all.push_back(element.as_table());
    }
    return all;
  }

  [[nodiscard]] std::string text(const toml::table& root, const toml::table& table, std::string_view key) const {
    const toml::node* node = table.get(key);
    if (node == nullptr) fail(table.source().begin.line == 0 ? root.source() : table.source(), std::string(key) + " is missing");
    const auto value = node->value_exact<std::string>();
    if (!value || value->empty()) fail(*node, std::string(key) + " is not a text");
    return *value;
  }

  [[nodiscard]] std::string text(const toml::table& table, std::string_view key) const { return text(table, table, key); }

  [[nodiscard]] std::string text_or(const toml::table& table, std::string_view key, const std::string& other) const {
    return table.contains(key) ? text(table, key) : other;
  }

  /// What names units and files of a study.
  [[nodiscard]] std::string name(const toml::table& table) const {
    const std::string value = text(table, "name");
    const bool is_plain = std::all_of(value.begin(), value.end(), [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' || c == '.';
    });
    if (!is_plain || value.size() > 60) {
      fail(*table.get("name"), "name is " + quoted(value) + ", but must be of up to 60 letters, digits, -, _ and .");
    }
    return value;
  }

  template <class Named>
  void require_new(const toml::table& table, const std::vector<Named>& all, const std::string& value) const {
    for (const Named& other : all) {
      if (other.name == value) fail(*table.get("name"), "name is " + quoted(value) + ", which another has already");
    }
  }

  [[nodiscard]] double number(const toml::node& node, std::string_view key, Field::Bounds bounds) const {
    const std::optional<double> value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value) fail(node, std::string(key) + " is not a number");
    if (!(*value >= bounds.low && *value <= bounds.high)) {
      std::ostringstream message;
      message << key << " is " << *value << ", but must be in " << bounds.low << ".." << bounds.high;
      fail(node, message.str());
    }
    return *value;
  }

  [[nodiscard]] std::int64_t whole(const toml::node& node, std::string_view key, Field::Bounds bounds) const {
    if (!node.is_integer()) fail(node, std::string(key) + " is not a whole number");
    return static_cast<std::int64_t>(number(node, key, bounds));
  }

  /// That a key names a setting, or is one of `others`; what it is set to is read by add_settings.
  void require_setting(const toml::key& key, std::initializer_list<std::string_view> others) const {
    if (find_field(key.str()) != nullptr || std::find(others.begin(), others.end(), key.str()) != others.end()) return;
    std::vector<std::string_view> known(others.begin(), others.end());
    for (const Field& field : fields()) known.push_back(field.name);
    fail(key.source(), "there is no setting " + quoted(key.str()) + "; there are " + list_of(known));
  }

  /// What a method is composed of, which would go before what maps or defaults say.
  void require_not_of_methods(const toml::key& key) const {
    for (const char* part : {"filter", "cells", "decision_cells"}) {
      if (key.str() == part) fail(key.source(), std::string(part) + " is for a method to say");
    }
  }

  void set(Settings& settings, const Field& field, const toml::node& node) const {
    if (const auto* member = std::get_if<double Settings::*>(&field.member)) {
      settings.**member = number(node, field.name, field.bounds);
    } else if (const auto* of_whole = std::get_if<int Settings::*>(&field.member)) {
      settings.**of_whole = static_cast<int>(whole(node, field.name, field.bounds));
    } else if (const auto* of_truth = std::get_if<bool Settings::*>(&field.member)) {
      if (!node.is_boolean()) fail(node, std::string(field.name) + " is not true or false");
      settings.**of_truth = *node.value<bool>();
    } else {
      const std::optional<std::string> word = node.value_exact<std::string>();
      if (!word || word->empty() || std::find(field.words.begin(), field.words.end(), *word) == field.words.end()) {
        fail(node, std::string(field.name) + " is " + (word ? quoted(*word) : "not a text") + ", but must be one of " + list_of(field.words));
      }
      settings.*std::get<std::string Settings::*>(field.member) = *word;
    }
  }

  void set_all(Settings& settings, const toml::table& table) const {
    for (auto&& [key, value] : table) {
      if (const Field* field = find_field(key.str())) set(settings, *field, value);
    }
  }

  void add_map(const toml::table& table) {
    StudyMap map;
    map.name = name(table);
    require_new(table, study_.maps, map.name);
    const bool is_read = table.contains("file");
    map.plan = text_or(table, "plan", "");
    if (is_read == !map.plan.empty()) fail(table, "the map " + quoted(map.name) + " must have either a file or a plan");
    if (is_read) {
      const std::filesystem::path given = text(table, "file");
      std::vector<std::filesystem::path> folders{file_.parent_path()};
      if (!data_.empty()) folders.push_back(data_);
      for (const std::filesystem::path& folder : folders) {
        std::error_code error;
        if (map.file.empty() && std::filesystem::is_regular_file(folder / given, error)) map.file = folder / given;
      }
      if (map.file.empty()) {
        fail(*table.get("file"), "there is no file " + quoted(given.string()) + " beside the study or in the data folder " +
                                     quoted(data_.string()));
      }
    } else if (map.plan == "generated") {
      const auto needed = [&](const char* key) -> const toml::node& {
        if (!table.contains(key)) fail(table, "the map " + quoted(map.name) + " is generated and must have " + std::string(key));
        return *table.get(key);
      };
      map.width_m = number(needed("width_m"), "width_m", {10, 500});
      map.height_m = number(needed("height_m"), "height_m", {10, 500});
      map.plan_seed = static_cast<std::uint64_t>(whole(needed("plan_seed"), "plan_seed", {0, 1e15}));
    } else if (std::find(drawn_plans().begin(), drawn_plans().end(), map.plan) == drawn_plans().end()) {
      fail(*table.get("plan"), "plan is " + quoted(map.plan) + ", but must be one of generated, " + list_of(drawn_plans()));
    }
    if (table.contains("corridor_max_m")) map.corridor_max_m = number(*table.get("corridor_max_m"), "corridor_max_m", {0.3, 50});
    for (auto&& [key, value] : table) {
      require_setting(key, {"name", "file", "plan", "width_m", "height_m", "plan_seed", "corridor_max_m"});
      require_not_of_methods(key);
      for (const char* of_generated : {"width_m", "height_m", "plan_seed"}) {
        if (key.str() == of_generated && map.plan != "generated") fail(key.source(), std::string(of_generated) + " is of generated plans alone");
      }
    }
    study_.maps.push_back(std::move(map));
  }

  void add_method(const toml::table& table) {
    const std::string called = name(table);
    require_new(table, study_.methods, called);
    const std::string like = text_or(table, "like", called);
    const std::optional<Method> known = find_method(like);
    if (!known) {
      std::vector<std::string_view> names;
      for (const Method& method : known_methods()) names.push_back(method.name);
      fail(table.contains("like") ? *table.get("like") : *table.get("name"),
           "there is no method " + quoted(like) + "; there are " + list_of(names));
    }
    for (auto&& [key, value] : table) {
      require_setting(key, {"name", "like", "what"});
      for (const char* of_trials : {"robot_radius_m", "range_max_m", "duration_s"}) {
        if (key.str() == of_trials) fail(key.source(), std::string(of_trials) + " is for defaults or a map to say, as methods are compared in the same trials");
      }
    }
    study_.methods.push_back({called, text_or(table, "what", std::string(known->what)), place(table.source())});
  }

  /// What holds for all comes first, then what holds for the map, what the method is, and what it sets itself.
  void add_settings(const toml::table* defaults, const toml::table& map, const toml::table& method) {
    Settings settings;
    if (defaults != nullptr) set_all(settings, *defaults);
    set_all(settings, map);
    find_method(text_or(method, "like", text(method, "name")))->compose(settings);
    set_all(settings, method);
    if (settings.cell_unoccupied_m <= settings.cell_occupied_m || settings.filter_unoccupied_m <= settings.filter_occupied_m) {
      fail(method, "the method " + quoted(text(method, "name")) + " has an unoccupied_m that is not above its occupied_m");
    }
    if (settings.decision_cells != "same" && (settings.cells != "t-bayes" || settings.filter == "dead-reckoning" || settings.filter == "none")) {
      fail(method, "the method " + quoted(text(method, "name")) +
                       " has decision_cells of its own, which needs the cells t-bayes and a filter that reads them");
    }
    study_.settings.push_back(settings);
  }

  [[nodiscard]] std::vector<int> numbers(const toml::table& table, const std::string& key) const {
    const toml::node* node = table.get(key);
    const toml::array* array = node == nullptr ? nullptr : node->as_array();
    if (array == nullptr || array->empty()) fail(node == nullptr ? table.source() : node->source(), key + " is not a list of whole numbers");
    std::vector<int> all;
    for (const toml::node& element : *array) {
      const int value = static_cast<int>(whole(element, key, {1, 1e9}));
      if (std::find(all.begin(), all.end(), value) != all.end()) fail(element, key + " has " + std::to_string(value) + " twice");
      all.push_back(value);
    }
    return all;
  }

  void add_trials(const toml::table& table) {
    allow(table, {"name", "starts", "seeds"});
    TrialGroup group;
    group.name = name(table);
    require_new(table, study_.trials, group.name);
    group.starts = numbers(table, "starts");
    group.seeds = numbers(table, "seeds");
    study_.trials.push_back(std::move(group));
  }

  void add_claim(const toml::table& table) {
    allow(table, {"says", "metric", "less", "more", "than", "maps", "as"});
    Claim claim;
    claim.says = text(table, "says");
    claim.metric = text(table, "metric");
    require_known(*table.get("metric"), "metric", claim.metric, table_metrics());
    claim.is_less = table.contains("less");
    if (claim.is_less == table.contains("more")) fail(table, "a claim has either less or more, and than");
    claim.better = side(table, claim.is_less ? "less" : "more");
    claim.worse = side(table, "than");
    if (claim.better.size() != claim.worse.size()) fail(*table.get("than"), "a claim compares two methods, or two differences of methods");
    if (claim.better == claim.worse) fail(*table.get("than"), "a claim compares something with itself");
    if (table.contains("as")) {
      require_known(*table.get("as"), "as", text(table, "as"), {"difference", "ratio"});
      claim.is_of_ratios = text(table, "as") == "ratio";
      const bool may_be_zero = claim.metric == "decisions" || claim.metric == "collisions" || claim.metric == "corridor_share";
      if (claim.is_of_ratios && may_be_zero) fail(*table.get("as"), claim.metric + " may be 0, and has no ratio");
      if (claim.is_of_ratios && claim.better.size() > 1) fail(*table.get("as"), "a ratio is of two methods, not of differences");
    }
    if (table.contains("maps")) {
      claim.maps = indices(table, "maps", study_.maps);
      if (claim.maps.empty()) fail(*table.get("maps"), "maps is empty");
    } else {
      claim.maps.resize(study_.maps.size());
      std::iota(claim.maps.begin(), claim.maps.end(), std::size_t{0});
    }
    for (const std::size_t map : claim.maps) {
      if (claim.metric == "corridor_share" && !study_.maps[map].corridor_max_m) {
        fail(*table.get("metric"), "corridor_share is not measured on the map " + quoted(study_.maps[map].name) + ", which has no corridor_max_m");
      }
    }
    study_.claims.push_back(std::move(claim));
  }

  /// A method, or a list of two.
  [[nodiscard]] Side side(const toml::table& table, const char* key) const {
    const toml::node* node = table.get(key);
    if (node == nullptr) fail(table, std::string(key) + " is missing");
    if (node->is_array()) {
      Side both = indices(table, key, study_.methods);
      if (both.size() != 2) fail(*node, std::string(key) + " must be a method, or a list of two");
      return both;
    }
    return {index(*node, key, text(table, key), study_.methods)};
  }

  template <class Named>
  [[nodiscard]] std::size_t index(const toml::node& node, const std::string& key, const std::string& value, const std::vector<Named>& all) const {
    std::vector<std::string> known;
    for (const Named& each : all) known.push_back(each.name);
    require_known(node, key, value, known);
    return static_cast<std::size_t>(std::find(known.begin(), known.end(), value) - known.begin());
  }

  template <class Named>
  [[nodiscard]] std::vector<std::size_t> indices(const toml::table& table, const char* key, const std::vector<Named>& all) const {
    std::vector<std::size_t> found;
    for (const std::string& value : texts(table, key)) found.push_back(index(*table.get(key), key, value, all));
    return found;
  }

  void require_known(const toml::node& node, const std::string& key, const std::string& value, const std::vector<std::string>& known) const {
    if (std::find(known.begin(), known.end(), value) == known.end()) {
      fail(node, key + " is " + quoted(value) + ", but must be one of " + list_of(known));
    }
  }

  /// A list of texts; empty where there is no such key.
  [[nodiscard]] std::vector<std::string> texts(const toml::table& table, const char* key) const {
    std::vector<std::string> all;
    const toml::node* node = table.get(key);
    if (node == nullptr) return all;
    const toml::array* array = node->as_array();
    if (array == nullptr) fail(*node, std::string(key) + " is not a list of texts");
    for (const toml::node& element : *array) {
      const std::optional<std::string> value = element.value_exact<std::string>();
      if (!value) fail(element, std::string(key) + " is not a list of texts");
      all.push_back(*value);
    }
    return all;
  }

  [[nodiscard]] std::vector<std::string> metrics(const toml::table& table, const char* key, const std::vector<std::string>& known) const {
    const std::vector<std::string> all = texts(table, key);
    for (const std::string& metric : all) {
      require_known(*table.get(key), key, metric, known);
      if (std::count(all.begin(), all.end(), metric) > 1) fail(*table.get(key), std::string(key) + " has " + quoted(metric) + " twice");
    }
    return all;
  }

  [[nodiscard]] static const std::vector<std::string>& drawn_plans() {
    static const std::vector<std::string> all = [] {
      std::vector<std::string> names{"embedded"};
      names.insert(names.end(), examples::study_plan_names.begin(), examples::study_plan_names.end());
      return names;
    }();
    return all;
  }

  std::filesystem::path file_;
  std::filesystem::path data_;
  std::filesystem::path shipped_;
  Study study_;
};

}  // namespace

Study read_study(const std::filesystem::path& file, const std::filesystem::path& data, const std::filesystem::path& shipped) {
  return StudyReader(file, data, shipped).read();
}

}  // namespace experiment
