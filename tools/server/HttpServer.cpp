// SPDX-License-Identifier: Apache-2.0
#include "tools/server/HttpServer.h"

#include "toolkit/json/JsonFile.h"

#include <fmt/format.h>

#include <httplib.h>

#include <chrono>
#include <functional>

namespace filament_core::server {
namespace {

constexpr const char* kRetrySeconds = "1";
constexpr time_t kIdleSeconds = 30;

} // namespace

struct HttpServer::Impl {
    RenderService& service;
    HttpSettings settings;
    httplib::Server server;
    socket_t listening = INVALID_SOCKET;

    Impl(RenderService& renderService, HttpSettings httpSettings)
            : service(renderService), settings(std::move(httpSettings)) {}

    using Handler = std::function<Answer(httplib::Request const&)>;
    httplib::Server::Handler route(std::string name, Handler handler) {
        return [this, name = std::move(name), handler = std::move(handler)](httplib::Request const& request,
                                                                            httplib::Response& response) {
            const auto begin = std::chrono::steady_clock::now();
            const Answer answer = handler(request);
            response.status = answer.status;
            response.set_content(answer.body, answer.contentType);
            if (!answer.id.empty()) response.set_header("Job-Id", answer.id);
            if (answer.status == 503) response.set_header("Retry-After", kRetrySeconds);
            service.metrics().answered(name, answer.status,
                                       std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
        };
    }

    void addRoutes() {
        const auto id = [](httplib::Request const& request) { return request.matches[1].str(); };
        server.Post("/v1/render",
                    route("render", [this](auto const& request) { return service.render(request.body); }));
        server.Post("/v1/jobs", route("submit", [this](auto const& request) { return service.submit(request.body); }));
        server.Post("/v1/check", route("check", [this](auto const& request) { return service.check(request.body); }));
        server.Get(R"(/v1/jobs/([^/]+))",
                   route("job", [=, this](auto const& request) { return service.job(id(request)); }));
        server.Get(R"(/v1/jobs/([^/]+)/image)",
                   route("image", [=, this](auto const& request) { return service.image(id(request)); }));
        server.Delete(R"(/v1/jobs/([^/]+))",
                      route("remove", [=, this](auto const& request) { return service.remove(id(request)); }));
        server.Get("/v1/schema",
                   route("schema", [](auto const&) { return Answer{ .body = SceneFile::schema(), .id = {} }; }));
        server.Get("/openapi.json",
                   route("openapi", [](auto const&) { return Answer{ .body = std::string(openApi()), .id = {} }; }));
        server.Get("/health", route("health", [this](auto const&) {
                       return service.isHealthy() ? Answer{ .body = "{\"status\": \"ok\"}\n", .id = {} }
                                                  : errorAnswer(503, "workers end without a job: see the server's log");
                   }));
        server.Get("/metrics", route("metrics", [this](auto const&) {
                       return Answer{ .contentType = "text/plain; version=0.0.4",
                                      .body = service.metrics().text(service.state()),
                                      .id = {} };
                   }));
        // What the library answers itself: unknown paths, bodies that are too large, broken HTTP.
        server.set_error_handler([](httplib::Request const&, httplib::Response& response) {
            if (!response.body.empty()) return;
            const char* text = response.status == 404   ? "there is no such path: see /openapi.json"
                               : response.status == 413 ? "the request is too large"
                                                        : "the request is no HTTP";
            response.set_content(errorAnswer(response.status, text).body, "application/json");
        });
        server.set_exception_handler([](httplib::Request const&, httplib::Response& response, std::exception_ptr) {
            response.status = 500;
            response.set_content(errorAnswer(500, "out of resources").body, "application/json");
        });
    }
};

HttpServer::HttpServer(RenderService& service, HttpSettings settings)
        : mImpl(std::make_unique<Impl>(service, std::move(settings))) {
    httplib::Server& server = mImpl->server;
    const size_t threads = mImpl->settings.threads;
    server.new_task_queue = [threads] { return new httplib::ThreadPool(threads); }; // the library deletes it
    server.set_payload_max_length(mImpl->settings.mostBytes);
    server.set_read_timeout(kIdleSeconds);
    server.set_write_timeout(kIdleSeconds);
    server.set_tcp_nodelay(true);
    // Not the library's SO_REUSEPORT: a second server would share the port, and answer half of the requests.
    server.set_socket_options([impl = mImpl.get()](socket_t socket) {
        const int on = 1;
        ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
        impl->listening = socket;
    });
    mImpl->addRoutes();
}

HttpServer::~HttpServer() = default;

Result<int> HttpServer::bind() {
    HttpSettings const& settings = mImpl->settings;
    const int port = settings.port == 0 ? mImpl->server.bind_to_any_port(settings.address)
                     : mImpl->server.bind_to_port(settings.address, settings.port) ? settings.port
                                                                                   : -1;
    // The library lets five connections wait to be accepted. Linux resets some of those beyond, and their requests are
    // lost; once more, listen(2) sets the length of the queue alone.
    if (port > 0 && ::listen(mImpl->listening, SOMAXCONN) == 0) return port;
    return Error{ ErrorCode::Unreadable,
                  fmt::format("cannot listen on {}:{}; is another program there? Give another --port", settings.address,
                              settings.port) };
}

void HttpServer::listen() { mImpl->server.listen_after_bind(); }
void HttpServer::stop() { mImpl->server.stop(); }

} // namespace filament_core::server
