// The JSON of a project.  Reading refuses whatever it does not know, and says where it is.
#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/base64.h"
#include "base/decimal.h"
#include "inkgrid/inkgrid.h"
#include "options.h"
#include "project/project.h"

namespace inkgrid {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kFormat = "inkgrid-project";
constexpr int kVersion = 1;
constexpr double kFurthest = 1e6;             // px; beyond any image
constexpr std::size_t kMostPoints = 200'000;  // of all scribbles: they are painted one by one
constexpr std::array kScribbleKinds{"less", "more", "erase"};
constexpr std::array kEditKinds{"delete", "split", "join"};

[[noreturn]] void refuse(const std::string& sentence) {
  throw Error(ErrorCode::file, sentence);
}

// A part of the file that knows where it is.
class Value {
 public:
  Value(const Json& json, std::string path) : json_(json), path_(std::move(path)) {}

  bool has(const std::string& name) const { return json_.contains(name); }

  Value at(const std::string& name) const {
    if (!has(name)) refuse(place() + " lacks '" + name + "'");
    return {json_.at(name), path_.empty() ? name : path_ + "." + name};
  }

  void check_names(std::span<const std::string_view> known) const {
    if (!json_.is_object()) refuse(place() + " must be an object");
    for (const auto& [name, value] : json_.items())
      if (std::find(known.begin(), known.end(), name) == known.end())
        refuse(place() + " holds '" + name + "', which inkgrid does not know");
  }

  std::vector<std::string> names() const {
    if (!json_.is_object()) refuse(place() + " must be an object");
    std::vector<std::string> names;
    for (const auto& [name, value] : json_.items()) names.push_back(name);
    return names;
  }

  std::vector<Value> items() const {
    if (!json_.is_array()) refuse(place() + " must be a list");
    std::vector<Value> values;
    for (const Json& item : json_) values.emplace_back(item, path_ + "[" + std::to_string(values.size()) + "]");
    return values;
  }

  bool is_text() const { return json_.is_string(); }

  std::string text() const {
    if (!is_text()) refuse(place() + " must be a text");
    return json_.get<std::string>();
  }

  std::string text_or_number() const {
    if (!is_text() && !json_.is_number()) refuse(place() + " must be a number or a text");
    return is_text() ? text() : shortest(json_.get<double>());
  }

  double number(double least, double most) const {
    const double value = json_.is_number() ? json_.get<double>() : std::nan("");
    if (!(least <= value && value <= most))
      refuse(place() + " must be a number from " + shortest(least) + " to " + shortest(most));
    return value;
  }

  Vec2 point() const {
    if (!json_.is_array() || json_.size() != 2) refuse(place() + " must be two numbers, x and y");
    const auto both = items();
    return {both[0].number(-kFurthest, kFurthest), both[1].number(-kFurthest, kFurthest)};
  }

  // The number of the text in the list.
  template <class Kind>
  Kind one_of(std::span<const char* const> names) const {
    const auto name = std::find(names.begin(), names.end(), text());
    if (name == names.end()) refuse(place() + " is '" + text() + "', which inkgrid does not know");
    return static_cast<Kind>(name - names.begin());
  }

 private:
  std::string place() const { return path_.empty() ? "the project" : path_; }

  const Json& json_;
  std::string path_;
};

constexpr std::array<std::string_view, 7> kProjectNames{"format", "version", "drawing", "mask", "options", "scribbles", "edits"};
constexpr std::array<std::string_view, 2> kFileNames{"name", "data"};
constexpr std::array<std::string_view, 3> kScribbleNames{"kind", "radius", "points"};
constexpr std::array<std::string_view, 4> kEditNames{"kind", "at", "to", "tolerance"};

ImageFile file_of(const Value& value) {
  value.check_names(kFileNames);
  std::optional<std::string> bytes = from_base64(value.at("data").text());
  if (!bytes) refuse("the image in it is damaged: it is not whole base64");
  return {value.at("name").text(), std::move(*bytes)};
}

Options options_of(const Value& value) {
  Options options;
  for (const std::string& name : value.names()) set_option(options, option_row(name), value.at(name).text_or_number());
  return options;
}

Scribble scribble_of(const Value& value) {
  value.check_names(kScribbleNames);
  Scribble scribble{value.at("kind").one_of<ScribbleKind>(kScribbleKinds), value.at("radius").number(0, kFurthest), {}};
  for (const Value& point : value.at("points").items()) scribble.points.push_back(point.point());
  return scribble;
}

Edit edit_of(const Value& value) {
  value.check_names(kEditNames);
  Edit edit;
  edit.kind = value.at("kind").one_of<EditKind>(kEditKinds);
  edit.at = value.at("at").point();
  if (edit.kind == EditKind::join) edit.to = value.at("to").point();
  if (value.has("tolerance")) edit.tolerance = value.at("tolerance").number(0, kFurthest);
  return edit;
}

Project project_of(const Value& value) {
  if (!value.has("format") || !value.at("format").is_text() || value.at("format").text() != kFormat)
    refuse("it is no inkgrid project");
  if (value.at("version").number(0, kFurthest) != kVersion) refuse("it was made by a version of inkgrid that is not known here");
  value.check_names(kProjectNames);
  Project project;
  project.drawing = file_of(value.at("drawing"));
  if (value.has("mask")) project.mask = file_of(value.at("mask"));
  if (value.has("options")) project.options = options_of(value.at("options"));
  if (value.has("scribbles"))
    for (const Value& scribble : value.at("scribbles").items()) project.scribbles.push_back(scribble_of(scribble));
  std::size_t points = 0;
  for (const Scribble& scribble : project.scribbles) points += scribble.points.size();
  if (points > kMostPoints) refuse("the scribbles have more than " + std::to_string(kMostPoints) + " points");
  if (value.has("edits"))
    for (const Value& edit : value.at("edits").items()) project.edits.push_back(edit_of(edit));
  return project;
}

Json json_of(Vec2 p) {
  return {p.x, p.y};
}

Json json_of(const ImageFile& file) {
  return {{"name", file.name}, {"data", base64(file.bytes)}};
}

Json json_of(const Options& options) {
  Json json = Json::object();
  for (const OptionRow& row : option_table()) {
    if (is_default(options, row)) continue;
    const std::string text = option_text(options, row);
    json[std::string(row.name)] = is_name(row) ? Json(text) : Json::parse(text);
  }
  return json;
}

Json json_of(const Scribble& scribble) {
  Json points = Json::array();
  for (const Vec2 p : scribble.points) points.push_back(json_of(p));
  return {{"kind", kScribbleKinds.at(static_cast<std::size_t>(scribble.kind))},
          {"radius", scribble.radius},
          {"points", std::move(points)}};
}

Json json_of(const Edit& edit) {
  Json json{{"kind", kEditKinds.at(static_cast<std::size_t>(edit.kind))}, {"at", json_of(edit.at)}};
  if (edit.kind == EditKind::join) json["to"] = json_of(edit.to);
  json["tolerance"] = edit.tolerance;
  return json;
}

// A member a line, and an item of a list a line.
std::string member(std::string_view name, const Json& json) {
  std::string text = ",\n\"" + std::string(name) + "\":";
  const auto dumped = [](const Json& part) { return part.dump(-1, ' ', false, Json::error_handler_t::replace); };
  if (!json.is_array()) return text + dumped(json);
  text += '[';
  for (std::size_t i = 0; i < json.size(); ++i) text += (i > 0 ? ",\n" : "\n") + dumped(json[i]);
  return text + ']';
}

template <class Item>
Json list_of(const std::vector<Item>& items) {
  Json json = Json::array();
  for (const Item& item : items) json.push_back(json_of(item));
  return json;
}

}  // namespace

std::string project_text(const Project& project) {
  std::string text = "{\"format\":\"" + std::string(kFormat) + "\",\"version\":" + std::to_string(kVersion);
  text += member("options", json_of(project.options));
  text += member("scribbles", list_of(project.scribbles));
  text += member("edits", list_of(project.edits));
  if (project.mask) text += member("mask", json_of(*project.mask));
  return text + member("drawing", json_of(project.drawing)) + "}\n";
}

Project parse_project(std::string_view text, const std::string& name) {
  try {
    return project_of({Json::parse(text), ""});
  } catch (const Json::exception&) {
    throw Error(ErrorCode::file, "'" + name + "' is no inkgrid project: it is no JSON that can be read");
  } catch (const Error& error) {
    throw Error(ErrorCode::file, "'" + name + "': " + error.what());
  }
}

}  // namespace inkgrid
