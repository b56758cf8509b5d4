#include "server.h"

#include <httplib.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "answers.h"
#include "documents.h"
#include "embedded.h"
#include "export/export.h"
#include "guard.h"
#include "pictures/stage_pictures.h"
#include "recording.h"
#include "report_json.h"
#include "solve.h"
#include "worker.h"

namespace inkgrid::studio {
namespace {

using httplib::Request;
using httplib::Response;

constexpr std::size_t kMostBytes = std::size_t{128} << 20;  // of an upload; a project is its drawing and a third more
constexpr std::size_t kConnections = 32;                    // at once
constexpr std::chrono::milliseconds kPulse{250};            // after which a connection that says nothing is tried

enum Status { kNoContent = 204, kRefused = 400, kForbidden = 403, kNotFound = 404, kStale = 409, kTooLarge = 413, kBroken = 500 };

// What a handler throws where the answer is no result.
struct Problem {
  int status;
  std::string sentence;
};

void tell_problem(Response& response, const Problem& problem) {
  response.status = problem.status;
  response.set_content(
      nlohmann::json{{"sentence", problem.sentence}}.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace),
      "application/json");
}

Asked asked_of(const Request& request) {
  return {request.path, request.get_header_value("Host"), request.get_header_value("Origin"),
          request.get_header_value("Sec-Fetch-Site"), request.get_header_value("X-Inkgrid-Token")};
}

void answer_file(const EmbeddedFile* file, Response& response) {
  if (!file) throw Problem{kNotFound, "there is no such page"};
  response.set_content(file->bytes.data(), file->bytes.size(), std::string(media_type(file->name)));
}

void answer_json(const std::string& json, Response& response) {
  response.set_content(json, "application/json");
}

// A drawing, or the project that holds one.
struct Opened {
  std::shared_ptr<Document> document;
  Project project;
};

bool looks_like_project(const std::string& bytes) {
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  return first != std::string::npos && bytes[first] == '{';
}

Opened open_file(Documents& documents, ImageFile file) {
  if (!looks_like_project(file.bytes)) return {documents.open(std::move(file)), {}};
  Project project = parse_project(file.bytes, file.name);
  auto document = documents.open(std::move(project.drawing));
  project.drawing = {};
  project_mask(project, document->image);  // throws where its mask is none
  return {std::move(document), std::move(project)};
}

void stream_events(const std::shared_ptr<EventStream>& events, Response& response) {
  response.set_chunked_content_provider(
      "text/event-stream",
      [events](std::size_t, httplib::DataSink& sink) {
        const std::optional<std::string> text = events->next(kPulse);
        if (text) return sink.write(text->data(), text->size());
        sink.done();
        return true;
      },
      [events](bool) { events->stop.request_stop(); });
}

// For this program alone, and at once where one before it has just ended.
void claim_port(socket_t socket) {
  const int yes = 1;
  setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
}

ExportOptions export_options_of(const std::string& body) {
  ExportOptions options;
  const auto asked = nlohmann::json::parse(body, nullptr, false);
  if (!asked.is_object()) throw Problem{kRefused, "the request is no JSON object"};
  for (const ExportOptionRow& row : export_option_table())
    if (const auto value = asked.find(row.name); value != asked.end() && value->is_string())
      set_option(options, row, value->get<std::string>());
  return options;
}

// The curves that the page shows; null where others have been found since.
std::shared_ptr<const Solved> shown_curves(const Request& request, Document& document) {
  auto solved = last_solved(document);
  return solved && solved->revision == request.get_param_value("revision") ? solved : nullptr;
}

// A page that asks while its curves are being replaced does nothing wrong: no error, which browsers would report.
void answer_changed(Response& response) {
  response.status = kNoContent;
}

}  // namespace

struct Server::Inside {
  httplib::Server http;
  std::string host;
  Guard guard;
  Documents documents;
  Opened first;  // what the page begins with
  Worker worker;

  Inside();
  void add_page();
  void add_opening();
  void add_documents();

  std::shared_ptr<Document> document_of(const Request& request);
  void answer_opened(const Opened& opened, Response& response);
  void answer_solve(const Request& request, Response& response);
  void answer_layer(const Request& request, Response& response);
  void answer_anchors(const Request& request, Response& response);
  void answer_export(const Request& request, Response& response);
};

Server::Inside::Inside() {
  guard.token = random_token();
  http.set_payload_max_length(kMostBytes);
  http.set_keep_alive_max_count(1);
  http.set_tcp_nodelay(true);
  http.set_socket_options(claim_port);
  http.new_task_queue = [] { return new httplib::ThreadPool(kConnections); };
  httplib::Headers headers;
  for (const auto& [name, value] : safety_headers()) headers.emplace(name, value);
  http.set_default_headers(headers);
  http.set_pre_routing_handler([this](const Request& request, Response& response) {
    const std::optional<std::string> reason = refusal(asked_of(request), guard);
    if (!reason) return httplib::Server::HandlerResponse::Unhandled;
    tell_problem(response, {kForbidden, *reason});
    return httplib::Server::HandlerResponse::Handled;
  });
  http.set_exception_handler([](const Request&, Response& response, const std::exception_ptr& thrown) {
    try {
      std::rethrow_exception(thrown);
    } catch (const Problem& problem) {
      tell_problem(response, problem);
    } catch (const Error& error) {
      tell_problem(response, {error.code() == ErrorCode::numerics ? kBroken : kRefused, error.what()});
    } catch (const std::bad_alloc&) {
      tell_problem(response, {kBroken, "there is not enough memory for this drawing"});
    } catch (const std::exception& error) {
      tell_problem(response, {kBroken, error.what()});
    }
  });
  http.set_error_handler([](const Request&, Response& response) {
    if (!response.body.empty()) return;
    const bool large = response.status == kTooLarge;
    tell_problem(response,
                 {response.status, large ? "the file is too large for the studio" : "there is nothing at this address"});
  });
  add_page();
  add_opening();
  add_documents();
}

void Server::Inside::add_page() {
  http.Get("/", [](const Request&, Response& response) { answer_file(find_embedded(embedded_page(), "index.html"), response); });
  http.Get(R"(/page/([a-z_.]+))", [](const Request& request, Response& response) {
    answer_file(find_embedded(embedded_page(), request.matches[1].str()), response);
  });
  http.Get(R"(/samples/([a-z0-9_.-]+))", [](const Request& request, Response& response) {
    answer_file(find_embedded(embedded_samples(), request.matches[1].str()), response);
  });
  http.Get("/api/about", [this](const Request&, Response& response) {
    answer_json(about_json(first.document ? first.document->id : ""), response);
  });
}

void Server::Inside::answer_opened(const Opened& opened, Response& response) {
  answer_json(document_json(*opened.document, opened.project), response);
}

void Server::Inside::add_opening() {
  http.Post("/api/documents", [this](const Request& request, Response& response) {
    answer_opened(open_file(documents, {request.get_param_value("name"), request.body}), response);
  });
  http.Post(R"(/api/samples/([a-z0-9_.-]+))", [this](const Request& request, Response& response) {
    const EmbeddedFile* file = find_embedded(embedded_samples(), request.matches[1].str());
    if (!file) throw Problem{kNotFound, "there is no such sample"};
    answer_opened(open_file(documents, {std::string(file->name), std::string(file->bytes)}), response);
  });
}

void Server::Inside::add_documents() {
  const std::string place = "/api/documents/([0-9a-f]+)";
  http.Get(place, [this](const Request& request, Response& response) {
    const auto document = document_of(request);
    answer_opened(document == first.document ? first : Opened{document, {}}, response);
  });
  http.Delete(place, [this](const Request& request, Response&) { documents.close(document_of(request)->id); });
  http.Get(place + "/file", [this](const Request& request, Response& response) {
    response.set_content(document_of(request)->file.bytes, "application/octet-stream");
  });
  http.Get(place + "/pixels", [this](const Request& request, Response& response) {
    const std::vector<std::uint8_t>& grey = document_of(request)->image.grey;
    response.set_content(reinterpret_cast<const char*>(grey.data()), grey.size(), "application/octet-stream");
  });
  http.Post(place + "/solve", [this](const Request& request, Response& response) { answer_solve(request, response); });
  http.Delete(place + "/solve", [this](const Request& request, Response&) {
    stop_job(*document_of(request), request.get_param_value("revision"));
  });
  http.Get(place + "/layers/([a-z]+)", [this](const Request& request, Response& response) { answer_layer(request, response); });
  http.Get(place + "/anchors/([0-9]{1,7})",
           [this](const Request& request, Response& response) { answer_anchors(request, response); });
  http.Post(place + "/export/([a-z]+)", [this](const Request& request, Response& response) { answer_export(request, response); });
}

std::shared_ptr<Document> Server::Inside::document_of(const Request& request) {
  auto document = documents.find(request.matches[1].str());
  if (!document) throw Problem{kNotFound, "this drawing is no longer open"};
  return document;
}

void Server::Inside::answer_solve(const Request& request, Response& response) {
  auto document = document_of(request);
  auto state = std::make_shared<const Project>(parse_project(request.body, "the request"));
  auto events = std::make_shared<EventStream>();
  const std::string revision = request.get_param_value("revision");
  take_over(*document, revision, events);
  worker.add([document, state, events, revision] { solve(*document, *state, revision, *events); });
  stream_events(events, response);
}

void Server::Inside::answer_layer(const Request& request, Response& response) {
  const auto document = document_of(request);
  const std::lock_guard lock(document->stages_mutex);
  if (!shown_curves(request, *document)) return answer_changed(response);
  Recording recording;
  if (!paint_stage(request.matches[2].str(), recording, document->stages)) throw Problem{kNotFound, "there is no such layer"};
  response.set_content(recording.take(), "application/octet-stream");
}

void Server::Inside::answer_anchors(const Request& request, Response& response) {
  const auto solved = shown_curves(request, *document_of(request));
  if (!solved) return answer_changed(response);
  const int curve = std::stoi(request.matches[2].str());
  if (curve >= static_cast<int>(solved->drawing.curves.size())) throw Problem{kNotFound, "there is no such curve"};
  answer_json(anchors_json(solved->drawing, curve), response);
}

void Server::Inside::answer_export(const Request& request, Response& response) {
  const auto solved = shown_curves(request, *document_of(request));
  if (!solved) throw Problem{kStale, "the curves have changed since"};
  const ExportFormat& format = export_format(request.matches[2].str());
  const std::string description = run_description(solved->options, solved->report);
  response.set_content(export_drawing(solved->drawing, format, export_options_of(request.body), description),
                       std::string(format.media_type));
}

Server::Server(const std::string& host, int port) : inside_(std::make_unique<Inside>()) {
  inside_->host = host;
  const bool bound = port == 0 || inside_->http.bind_to_port(host, port);
  inside_->guard.port = port != 0 ? port : inside_->http.bind_to_any_port(host);
  if (!bound || inside_->guard.port <= 0)
    throw Error(ErrorCode::usage,
                "can't listen on port " + std::to_string(port) + " of '" + host + "': it is taken or not allowed");
}

Server::~Server() = default;

void Server::open(ImageFile file) {
  inside_->first = open_file(inside_->documents, std::move(file));
}

std::string Server::address() const {
  const bool six = inside_->host.find(':') != std::string::npos;
  const std::string host = six ? "[" + inside_->host + "]" : inside_->host;
  return "http://" + host + ":" + std::to_string(inside_->guard.port) + "/#" + inside_->guard.token;
}

void Server::listen() {
  inside_->http.listen_after_bind();
}

}  // namespace inkgrid::studio
