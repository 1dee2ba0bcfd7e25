#include "completions.h"
#include "interrupt.h"
#include "manual_pages.h"
#include "verb.h"

#include "tilepack/error/error.h"
#include "tilepack/error/nearest_name.h"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fcntl.h>
#include <filesystem>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <unistd.h>
#include <vector>

namespace tilepack::cli {
namespace {

constexpr const char* exit_codes =
    "Exit codes: 0 ok, 1 usage, 2 cannot read, 3 invalid content, 4 cannot write,\n"
    "5 a check failed or images differ, 6 internal error.\n";

const Verb* find_verb(const std::string& name) {
  const auto verbs = verb_table();
  const auto found = std::find_if(verbs.begin(), verbs.end(), [&](const Verb& v) { return v.name == name; });
  return found == verbs.end() ? nullptr : &*found;
}

std::string listing() {
  std::string text =
      "tilepack turns texture samples into tile packs, and renders, measures and checks them.\n\n"
      "Usage: tilepack VERB [OPTIONS]\n\nVerbs:\n";
  for (const Verb& verb : verb_table()) text += fmt::format("  {:<10} {}\n", verb.name, verb.summary);
  text += fmt::format("  {:<10} {}\n", "help", "this list, or the help of one verb: tilepack help VERB");
  text +=
      "\n`tilepack VERB --help` has the options and an example. `tilepack --version` prints the version,\n"
      "`tilepack help --man [VERB]` a manual page, `tilepack help --completion bash|zsh|fish` a script for "
      "that shell.\n";
  return text + exit_codes;
}

// What someone meant who named a file in place of a verb; empty if that is none.
std::string meant_by_file(const std::string& name) {
  namespace fs = std::filesystem;
  std::error_code unused;
  const fs::path path(name);
  const std::string stem = (path.has_filename() ? path : path.parent_path()).stem().string();
  if (fs::is_regular_file(path / "pack.json", unused) || path.filename() == "pack.json")
    return fmt::format("'{0}' is a pack; to see what it holds: `tilepack inspect {0}`", name);
  // No verb has an ending or lies in a folder.
  if (fs::exists(path, unused) || (name.front() != '-' && (path.has_extension() || path.has_parent_path())))
    return fmt::format("'{0}' is no verb; to bake it: `tilepack bake {0} -o {1}.pack`", name,
                       stem.empty() || stem.front() == '.' ? "material" : stem);
  return "";
}

const Verb& verb_named(const std::string& name) {
  if (const Verb* verb = find_verb(name)) return *verb;
  if (name == "version" || name == "-v" || name == "-V")
    throw Error(ErrorKind::usage, "",
                fmt::format("there is no verb '{}'; `tilepack --version` prints the version", name));
  if (const std::string meant = meant_by_file(name); !meant.empty()) throw Error(ErrorKind::usage, "", meant);
  std::vector<std::string> known{"help"};
  for (const Verb& verb : verb_table()) known.push_back(verb.name);
  const std::string nearest = nearest_name(name, known);
  throw Error(ErrorKind::usage, "",
              fmt::format("there is no verb '{}'; {}", name,
                          nearest.empty() ? "`tilepack help` lists them"
                                          : fmt::format("did you mean '{}'?", nearest)));
}

int run_verb(const Verb& verb, const std::vector<std::string>& arguments, Console& console) {
  Options options({"tilepack " + verb.name, verb.summary, verb.example, verb.more});
  options.group("General");
  options.flag("-q,--quiet", console.quiet,
               "no progress, notes and warnings, and no summary of what was made");
  options.group("");
  const Action action = verb.declare(options);
  if (!options.parse(arguments)) {
    console.print(options.help());
    return 0;
  }
  if (interrupted()) throw Interrupted();
  return action(console);
}

// `tilepack help --man [VERB]` and `tilepack help --completion SHELL`: what is installed beside the program.
bool print_made(const std::vector<std::string>& arguments, Console& console) {
  const std::string argument = arguments.size() > 2 ? arguments[2] : "";
  if (arguments[1] == "--man") {
    console.print(argument.empty() ? manual_of_all() : manual_of(verb_named(argument)));
    return true;
  }
  if (arguments[1] != "--completion") return false;
  if (argument != "bash" && argument != "zsh" && argument != "fish")
    throw Error(ErrorKind::usage, "--completion",
                fmt::format("'{}' is not allowed; it must be bash, zsh or fish", argument));
  console.print(completion_for(argument));
  return true;
}

// What someone meant who gave options before the verb.
[[noreturn]] void refuse_option_first(const std::vector<std::string>& arguments) {
  const auto verb = std::find_if(arguments.begin(), arguments.end(),
                                 [](const std::string& word) { return find_verb(word) != nullptr; });
  if (verb == arguments.end())
    throw Error(ErrorKind::usage, "",
                fmt::format("'{}' is no verb, and one is missing; `tilepack help` lists them", arguments[0]));
  std::string meant = ": tilepack " + *verb;
  for (auto word = arguments.begin(); word != arguments.end(); ++word)
    if (word != verb) meant += ' ' + *word;
  throw Error(ErrorKind::usage, "",
              fmt::format("'{}' stands before the verb; options come after it{}", arguments[0], meant));
}

int run(const std::vector<std::string>& arguments, Console& console) {
  const std::string first = arguments.empty() ? "" : arguments[0];
  if (first.empty()) throw Error(ErrorKind::usage, "", "a verb is missing; `tilepack help` lists them");
  if (first == "--version") {
    console.print("tilepack " TILEPACK_VERSION "\n");
    return 0;
  }
  if (first == "help" || first == "--help" || first == "-h") {
    if (arguments.size() > 1 && print_made(arguments, console)) return 0;
    if (arguments.size() < 2 || arguments[1] == "--help" || arguments[1] == "-h")
      console.print(listing());
    else
      return run_verb(verb_named(arguments[1]), {"--help"}, console);
    return 0;
  }
  if (first == "-v" || first == "-V") verb_named(first);
  if (first.front() == '-') refuse_option_first(arguments);
  return run_verb(verb_named(first), {arguments.begin() + 1, arguments.end()}, console);
}

constexpr const char* no_memory = "out of memory; smaller tiles, fewer colors or a smaller image need less";

// Of an exception that none of us has thrown: libraries have types of their own for what the system refuses.
std::string refusal_in(const std::exception& error) {
  const std::string_view what = error.what();
  if (what.find("Insufficient memory") != what.npos) return no_memory; // cv::Exception
  if (what.find("pthread_create") == what.npos && dynamic_cast<const std::system_error*>(&error) == nullptr)
    return "";
  return fmt::format(
      "out of memory, or of the processes that are allowed ({}); raise the limits (ulimit -v, -u), or try "
      "--jobs 1",
      what);
}

// Of paths that can't be worked with; the current folder, where outputs would go, is the one that nobody names.
Error path_fault(const std::filesystem::filesystem_error& error) {
  std::error_code gone;
  static_cast<void>(std::filesystem::current_path(gone));
  if (gone)
    return Error(ErrorKind::cannot_write, "", "the current folder was removed; change to one that is there");
  return Error(ErrorKind::cannot_read, error.path1().string(),
               error.code().message() + "; check the path and its permissions");
}

// The one place where an exception becomes a message and an exit code.
int guarded_run(const std::vector<std::string>& arguments) {
  const bool has_verb = !arguments.empty() && find_verb(arguments[0]) != nullptr;
  Console console(has_verb ? "tilepack " + arguments[0] : "tilepack");
  std::atomic_flag said;
  const InterruptWatch watch([&](bool something_is_in_place) {
    if (!said.test_and_set())
      console.last_note(something_is_in_place ? "interrupted; what was finished is kept"
                                              : "interrupted; nothing was written");
  });
  const auto fails = [&](ErrorKind kind, const std::string& message) {
    console.error(message);
    return exit_code(kind);
  };
  try {
    return run(arguments, console);
  } catch (const Interrupted& interrupt) {
    if (!said.test_and_set()) console.note(std::string("interrupted; ") + interrupt.left);
  } catch (const Error& error) {
    return fails(error.kind(), error.message(FieldSpelling::option));
  } catch (const std::bad_alloc&) {
    return fails(ErrorKind::internal, no_memory);
  } catch (const std::filesystem::filesystem_error& error) {
    const Error fault = path_fault(error);
    return fails(fault.kind(), fault.message(FieldSpelling::option));
  } catch (const std::exception& error) {
    const std::string refusal = refusal_in(error);
    return fails(ErrorKind::internal,
                 refusal.empty() ? std::string("internal fault: ") + error.what() : refusal);
  }
  return -1;
}

// A stream that was closed would be the next file that is opened, and what is printed would go into that. In place of
// stdout stands what can't be written, so that what was to be printed is missed.
void hold_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0 && errno == EBADF)
      static_cast<void>(::open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY));
}

} // namespace
} // namespace tilepack::cli

int main(int argc, char** argv) {
  tilepack::cli::hold_closed_streams();
  // OpenImageIO, where it is loaded, brings OpenBLAS, which starts a thread a core then. Each takes 128 MiB of
  // address space, and where it gets none tries for ever; where a thread is refused, it sends the program a SIGINT.
  // Nothing here multiplies matrices with it, but it can only be told by its environment.
  ::setenv("OPENBLAS_NUM_THREADS", "1", 0);
  const int code = tilepack::cli::guarded_run({argv + 1, argv + argc});
  if (code < 0) tilepack::cli::end_by_signal();
#ifdef TILEPACK_SANITIZED
  return code; // leaks are looked for on the way out
#else
  // Nothing is left to do, and some libraries wait for ever for threads that too little memory kept from
  // starting when they are shut down.
  std::fflush(nullptr);
  std::quick_exit(code);
#endif
}
