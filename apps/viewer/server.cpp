// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/viewer/server.hpp"

#include "apps/viewer/live_run.hpp"
#include "apps/viewer/page.hpp"
#include "apps/viewer/view_error.hpp"

#include <fmt/format.h>

#ifdef PLEKTON_HAS_HTTPLIB
#include <httplib.h>

#include <chrono>
#include <mutex>
#include <thread>
#endif

namespace plekton::apps {

#ifdef PLEKTON_HAS_HTTPLIB

namespace {

constexpr const char* kHost = "127.0.0.1";  // this machine only

/// A page of another site that had its name point here would ask with that name.
bool is_asked_by_us(const httplib::Request& request, int port) {
  const std::string host = request.get_header_value("Host");
  return host == fmt::format("127.0.0.1:{}", port) || host == fmt::format("localhost:{}", port);
}

/// Answers for a run, one request at a time where the run is read.
class Answers {
 public:
  Answers(const ServeSettings& settings, httplib::Server& server)
      : run_(settings.folder, settings.limit), page_(live_page()) {
    server.Get("/", [&](const auto&, auto& answer) {
      answer.set_content(page_, "text/html; charset=utf-8");
    });
    server.Get("/header", [&](const auto&, auto& answer) {
      const std::lock_guard lock(mutex_);
      run_.refresh();
      answer.set_content(run_.header(), "application/json");
    });
    server.Get(R"(/block/(\d+)/(\w+))", [&](const auto& request, auto& answer) {
      const std::lock_guard lock(mutex_);
      const auto text = run_.block(request.matches[1].str(), request.matches[2].str());
      if (text)
        answer.set_content(*text, "text/plain");
      else
        answer.status = 404;
    });
  }

 private:
  std::mutex mutex_;
  LiveRun run_;
  std::string page_;
};

}  // namespace

bool can_serve() noexcept {
  return true;
}

void serve_run(const ServeSettings& settings) {
  httplib::Server server;
  // Not as the library does, which lets two servers share a port and answers at random.
  server.set_socket_options([](socket_t socket) {
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  const Answers answers(settings, server);
  int port = settings.port;
  if (port == 0)
    port = server.bind_to_any_port(kHost);
  else if (!server.bind_to_port(kHost, port))
    port = -1;
  if (port < 0)
    throw ViewError(fmt::format("--serve: port {} of {} is taken; choose another, or 0 for any",
                                settings.port, kHost));
  server.set_pre_routing_handler(
      [port](const httplib::Request& request, httplib::Response& answer) {
        if (is_asked_by_us(request, port)) return httplib::Server::HandlerResponse::Unhandled;
        answer.status = 403;
        return httplib::Server::HandlerResponse::Handled;
      });
  std::thread listener([&] { server.listen_after_bind(); });
  settings.hear(fmt::format("http://{}:{}/", kHost, port));
  while (!settings.is_interrupted()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  server.stop();
  listener.join();
}

#else

bool can_serve() noexcept {
  return false;
}

void serve_run(const ServeSettings&) {
  throw ViewError(
      "--serve: this program was compiled without cpp-httplib; install libcpp-httplib-dev (Debian) "
      "and compile it again, or write a page without --serve");
}

#endif

}  // namespace plekton::apps
