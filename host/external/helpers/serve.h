// What every helper program does around its work.
#pragma once

#include <signal.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <functional>
#include <new>
#include <string>
#include <string_view>

namespace swage {

/// Answers the message on stdin on stdout. What the work prints goes to stderr; where it throws, so does what it says,
/// and the exit status is 1.
inline int serve(const std::function<std::string(std::string_view)>& work) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // Nobody waits for the answer once the caller is gone.
  try {
    std::FILE* answers = fdopen(dup(STDOUT_FILENO), "wb");
    if (answers == nullptr || dup2(STDERR_FILENO, STDOUT_FILENO) < 0) throw std::bad_alloc();
    std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
    std::string message;
    char buffer[1 << 16];
    while (const std::size_t count = std::fread(buffer, 1, sizeof buffer, stdin)) message.append(buffer, count);
    const std::string answer = work(message);
    const bool written = std::fwrite(answer.data(), 1, answer.size(), answers) == answer.size();
    return std::fclose(answers) == 0 && written ? 0 : 1;
  } catch (const std::bad_alloc&) {
    std::fputs("the memory that it may use does not suffice\n", stderr);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
  }
  return 1;
}

}  // namespace swage
