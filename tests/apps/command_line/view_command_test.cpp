// SPDX-License-Identifier: GPL-3.0-or-later
#include "apps/viewer/server.hpp"
#include "tests/apps/command_line/command_fixture.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <regex>

namespace plekton::apps::view_command_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class ViewCommand : public Command {
 protected:
  void run() const {
    ASSERT_EQ(outcome_of({"run", scenario(), "--out", out(), "--quiet"}).exit_code, kDone);
  }
  std::string page() const { return out() + "/view.html"; }
};

TEST_F(ViewCommand, IsWhatARunEndsWith) {
  const Outcome outcome = outcome_of({"run", scenario(), "--out", out()});

  EXPECT_THAT(outcome.out, testing::EndsWith("look at it: plekton view " + out() + "\n"));
}

TEST_F(ViewCommand, WritesOnePageThatLoadsNothing) {
  run();

  const Outcome outcome = outcome_of({"view", out()});

  ASSERT_EQ(outcome.exit_code, kDone) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("view.html: 5 frames"));
  const std::string text = test::bytes_of(page());
  EXPECT_THAT(text, AllOf(StartsWith("<!DOCTYPE html>"), HasSubstr("id=\"block-4\""),
                          HasSubstr("three.js authors"), HasSubstr("Leon Sorokin")));
  for (const char* loads : {"src=\"", "href=\"", "@import", "url(http"})
    EXPECT_THAT(text, Not(HasSubstr(loads)));
}

TEST_F(ViewCommand, RefusesALimitThatIsNoNumber) {
  run();

  const Outcome outcome = outcome_of({"view", out(), "--limit", "nan"});

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("--limit: got nan; expected a number from 0.1 to 4000"));
  EXPECT_FALSE(std::filesystem::exists(page()));
}

TEST_F(ViewCommand, ReplacesItsOwnPageButNoOtherFile) {
  run();
  ASSERT_EQ(outcome_of({"view", out()}).exit_code, kDone);
  EXPECT_EQ(outcome_of({"view", out()}).exit_code, kDone);

  const std::string energy = test::bytes_of(out() + "/energy.csv");
  const Outcome outcome = outcome_of({"view", out(), "--out", out() + "/energy.csv"});

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("no page of plekton view"));
  EXPECT_EQ(test::bytes_of(out() + "/energy.csv"), energy);
}

TEST_F(ViewCommand, ShowsARunThatWasBrokenOffAndSaysSo) {
  run();
  std::filesystem::remove(out() + "/run.json");

  const Outcome outcome = outcome_of({"view", out()});

  EXPECT_EQ(outcome.exit_code, kDone);
  EXPECT_THAT(outcome.out, HasSubstr("note: the run has not ended, or was broken off"));
}

TEST_F(ViewCommand, SaysWhatIsWrongInOneLineAndLeavesNothing) {
  run();
  const std::string frame = out() + "/frames/membranes_00003.vtp";
  const std::string bytes = test::bytes_of(frame);
  test::write_bytes(frame, bytes.substr(0, bytes.size() / 3));

  const Outcome outcome = outcome_of({"view", out()});

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("membranes_00003.vtp: is no frame of plekton"));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1);
  EXPECT_FALSE(std::filesystem::exists(page()));
  EXPECT_FALSE(std::filesystem::exists(page() + ".part"));
  EXPECT_EQ(outcome_of({"view", out() + "/none"}).exit_code, kFailed);
}

TEST_F(ViewCommand, RefusesARunWithoutFrames) {
  ASSERT_EQ(
      outcome_of({"run", scenario(), "--out", out(), "--quiet", "--set", "output.grains=false",
                  "--set", "output.membranes=false", "--set", "output.contacts=false"})
          .exit_code,
      kDone);

  const Outcome outcome = outcome_of({"view", out()});

  EXPECT_EQ(outcome.exit_code, kFailed);
  EXPECT_THAT(outcome.err, HasSubstr("the run has no frames"));
}

/// What a server of this machine answers.
std::string answer_of(int port, const std::string& path, const std::string& host) {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  std::string answer;
  if (::connect(socket, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0) {
    const std::string request =
        "GET " + path + " HTTP/1.1\r\nHost: " + host + "\r\nConnection: close\r\n\r\n";
    (void)!::write(socket, request.data(), request.size());
    char bytes[4096];
    for (ssize_t n; (n = ::read(socket, bytes, sizeof bytes)) > 0;)
      answer.append(bytes, static_cast<std::size_t>(n));
  }
  ::close(socket);
  return answer;
}

TEST_F(ViewCommand, ServesThisMachineUntilItIsInterrupted) {
  if (!can_serve()) GTEST_SKIP() << "compiled without cpp-httplib";
  run();
  const test::TemporaryFolder folder;
  const auto said = folder / "said";
  Program program({"view", out(), "--serve", "0"}, [&] {
    const int file = ::open(said.c_str(), O_WRONLY | O_CREAT, 0600);
    ::dup2(file, STDOUT_FILENO);
  });
  std::smatch match;
  std::string text;
  for (int i = 0; i < 6000 && match.empty(); ++i) {
    text = test::bytes_of(said);
    std::regex_search(text, match, std::regex("http://127.0.0.1:([0-9]+)/"));
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ASSERT_FALSE(match.empty()) << text;
  const int port = std::stoi(match[1]);
  const std::string own = "127.0.0.1:" + match[1].str();

  EXPECT_THAT(answer_of(port, "/", own), AllOf(HasSubstr("200 OK"), HasSubstr("plekton-live")));
  const std::string header = answer_of(port, "/header", own);
  ASSERT_TRUE(std::regex_search(header, match, std::regex("\"generation\":([0-9]+)")));
  const std::string blocks = "/block/" + match[1].str();
  EXPECT_THAT(answer_of(port, blocks + "/4", own), HasSubstr("200 OK"));
  EXPECT_THAT(answer_of(port, blocks + "/99", own), HasSubstr("404"));
  EXPECT_THAT(answer_of(port, "/../run.json", own), Not(HasSubstr("200 OK")));
  EXPECT_THAT(answer_of(port, "/", "elsewhere.example"), HasSubstr("403"));
  // Two on one port answered in turns.
  EXPECT_THAT(outcome_of({"view", out(), "--serve", std::to_string(port)}).err,
              HasSubstr("is taken"));
  program.send(SIGINT);
  EXPECT_EQ(program.wait().exit_code, kDone);
}

TEST_F(ViewCommand, NeedsNoPortToServe) {
  const Outcome outcome = outcome_of({"view", out(), "--serve"});

  EXPECT_THAT(outcome.err, HasSubstr("there is no such folder"));
}

TEST_F(ViewCommand, SaysWhatIsNoPort) {
  for (const char* port : {"abc", "-1", "70000", "80x"})
    EXPECT_THAT(outcome_of({"view", out(), "--serve", port}).err, HasSubstr("expected a port"));
}

}  // namespace
}  // namespace plekton::apps::view_command_test
