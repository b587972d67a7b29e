// SPDX-License-Identifier: Apache-2.0
/// HttpServer: the routes of docs/server.md over a RenderService, by cpp-httplib.
///   Thread  listen() blocks its thread and answers on `threads` others; stop() any.
///   Fails   Unreadable if the port cannot be had.
#pragma once

#include "tools/server/RenderService.h"

#include <cstddef>
#include <memory>
#include <string>

namespace filament_core::server {

struct HttpSettings {
    std::string address = "127.0.0.1";
    int port = 8080; ///< 0: any that is free
    uint32_t threads = 64;
    size_t mostBytes = size_t{ 8 } << 20; ///< of a request
};

class HttpServer {
public:
    HttpServer(RenderService& service, HttpSettings settings);
    ~HttpServer();

    Result<int> bind(); ///< the port
    void listen();      ///< until stop()
    void stop();

private:
    struct Impl;
    std::unique_ptr<Impl> mImpl;
};

/// The description of the routes, OpenAPI 3.1: docs/server-openapi.json.
std::string_view openApi();

} // namespace filament_core::server
