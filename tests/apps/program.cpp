#include "program.hpp"

#include "files/whole_file.hpp"

#include <nlohmann/json.hpp>

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <stdexcept>
#include <thread>

namespace talus {

namespace {

/// Exit code that a shell gives where a program could not be started.
constexpr int not_started = 127;

void redirect(const std::filesystem::path& file, int descriptor) {
  const int opened = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (opened < 0 || dup2(opened, descriptor) < 0) _exit(not_started);
}

pid_t start(const std::filesystem::path& program, const std::filesystem::path& folder,
            const std::vector<std::string>& words) {
  std::vector<std::string> all{program.string()};
  all.insert(all.end(), words.begin(), words.end());
  std::vector<char*> arguments;
  for (std::string& word : all) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const std::filesystem::path out = folder / "stdout.txt", err = folder / "stderr.txt";
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot start a process");
  if (child == 0) {
    redirect(out, STDOUT_FILENO);
    redirect(err, STDERR_FILENO);
    if (chdir(folder.c_str()) != 0) _exit(not_started);
    execv(arguments[0], arguments.data());
    _exit(not_started);
  }
  return child;
}

Call finish(pid_t child, const std::filesystem::path& folder) {
  int status = 0;
  if (waitpid(child, &status, 0) != child) throw std::runtime_error("lost a process");
  Call call;
  call.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  call.out = read_whole_file(folder / "stdout.txt");
  call.err = read_whole_file(folder / "stderr.txt");
  return call;
}

}  // namespace

Call call_program(const std::filesystem::path& program, const std::filesystem::path& folder,
                  const std::vector<std::string>& words) {
  return finish(start(program, folder, words), folder);
}

Call call_talus(const std::filesystem::path& folder, const std::vector<std::string>& words) {
  return call_program(TALUS_PROGRAM, folder, words);
}

Call call_and_signal(const std::filesystem::path& folder, const std::vector<std::string>& words, int signal,
                     const std::filesystem::path& file) {
  const pid_t child = start(TALUS_PROGRAM, folder, words);
  for (int i = 0; i < 3000 && !std::filesystem::exists(file); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  kill(child, signal);
  return finish(child, folder);
}

Call call_and_signal_after(const std::filesystem::path& folder, const std::vector<std::string>& words,
                           int signal, double seconds) {
  const pid_t child = start(TALUS_PROGRAM, folder, words);
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  kill(child, signal);
  return finish(child, folder);
}

std::string small_scene() {
  return R"({
  // a block falls on a slab
  "talus": 1,
  "title": "small",
  "gravity": [0, -10],
  "materials": {"rock": {"density": 2000}},
  "cover": {"model": "rigid"},
  "contact": {"model": "overlap_area"},
  "interfaces": [{"between": ["*", "*"], "normal_stiffness": 1e8, "tangential_stiffness": 1e8,
                  "friction_angle": 30, "normal_damping": 0.3, "tangential_damping": 0.3}],
  "bodies": [
    {"name": "slab", "polygon": [[-2, -1], [2, -1], [2, 0], [-2, 0]], "material": "rock", "fixed": true},
    {"name": "block", "polygon": [[0, 0.01], [1, 0.01], [1, 1.01], [0, 1.01]], "material": "rock"}
  ],
  "monitors": [{"name": "block", "body": "block"}],
  "time": {"end": 0.2},
  "output": {"history": 0.01, "frames": 0.1}
})";
}

nlohmann::json json_of(const std::filesystem::path& file) {
  return nlohmann::json::parse(read_whole_file(file));
}

}  // namespace talus
