#include "frontend/join_processes.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace epiline::frontend {

namespace {

class joiner {
 public:
  joiner(const split_top& split, const std::vector<lowered_process>& lowered, std::vector<dataflow::graph> graphs)
      : split_(split), lowered_(lowered) {
    network_.name = split.name;
    network_.processes = std::move(graphs);
  }

  dataflow::network join() {
    for (const internal_stream& stream : split_.streams) add_fifo(stream);
    add_ports(dataflow::port_kind::stream);
    add_call();
    add_ports(dataflow::port_kind::result);
    check_parameters();
    if (std::none_of(network_.ports.begin(), network_.ports.end(), [](const auto& port) { return !port.input; }))
      refuse(split_.top.place,
             "the top has no output: give results through an hls::stream or a scalar by reference, or nothing can be "
             "seen of it");
    for (const process_source& process : split_.processes)
      network_.called.push_back(location(network_.files, process.place));
    return std::move(network_);
  }

 private:
  static dataflow::source_location location(std::vector<std::string>& files, const source_place& place) {
    if (place.line == 0) return {};
    const auto found = std::find(files.begin(), files.end(), place.file);
    const auto file = static_cast<std::uint32_t>(found - files.begin());
    if (found == files.end()) files.push_back(place.file);
    return {file, place.line};
  }

  /// The processes that have a port of that name and direction, in the order of their calls.
  [[nodiscard]] std::vector<std::size_t> users(const std::string& name, dataflow::port_kind kind, bool input) const {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < network_.processes.size(); ++i)
      for (const dataflow::port& port : network_.processes[i].ports)
        if (port.kind == kind && port.name == name && port.input == input) found.push_back(i);
    return found;
  }

  [[noreturn]] void refuse_second(const std::string& stream, const std::vector<std::size_t>& users, bool input) const {
    const char* const done = input ? "read" : "written";
    refuse(split_.processes[users[1]].place,
           fmt::format("the stream '{}' is {} by two processes, '{}' and '{}': a stream has one writer and one reader: "
                       "{}",
                       stream, done, split_.processes[users[0]].name, split_.processes[users[1]].name,
                       input ? "let a process copy its tokens into two streams"
                             : "let each write into a stream of its own, and a process merge them"));
  }

  dataflow::port& port_of(std::size_t process, const std::string& name) {
    std::vector<dataflow::port>& ports = network_.processes[process].ports;
    return *std::find_if(ports.begin(), ports.end(), [&](const dataflow::port& port) {
      return port.name == name && port.kind != dataflow::port_kind::call;
    });
  }

  void add_fifo(const internal_stream& stream) {
    const std::vector<std::size_t> writers = users(stream.name, dataflow::port_kind::stream, false);
    const std::vector<std::size_t> readers = users(stream.name, dataflow::port_kind::stream, true);
    if (writers.empty() && readers.empty())
      refuse(stream.place, fmt::format("the stream '{}' is never read or written: remove it", stream.name));
    if (readers.empty())
      refuse(stream.place, fmt::format("the stream '{}' is written by the process '{}' and never read: read it, or "
                                       "remove it",
                                       stream.name, split_.processes[writers[0]].name));
    if (writers.empty())
      refuse(stream.place, fmt::format("the stream '{}' is read by the process '{}' and never written", stream.name,
                                       split_.processes[readers[0]].name));
    if (writers.size() > 1) refuse_second(stream.name, writers, false);
    if (readers.size() > 1) refuse_second(stream.name, readers, true);
    if (readers[0] < writers[0] && !stream.is_static)
      refuse(split_.processes[readers[0]].place,
             fmt::format("the stream '{}' is read by the process '{}', which is called before its writer '{}': the C++ "
                         "program could never serve that: call the writer first",
                         stream.name, split_.processes[readers[0]].name, split_.processes[writers[0]].name));
    for (const std::size_t end : {writers[0], readers[0]})
      port_of(end, stream.name).where = location(network_.processes[end].files, stream.place);
    network_.fifos.push_back(
        {stream.name, port_of(writers[0], stream.name).width, stream.depth, location(network_.files, stream.place)});
  }

  /// Those of the top, in the order of its parameters.
  void add_ports(dataflow::port_kind kind) {
    for (const auto& [index, name] : split_.top.parameters) {
      for (const bool input : {true, false}) {
        const std::vector<std::size_t> found = users(name, kind, input);
        if (found.empty()) continue;
        if (found.size() > 1) refuse_second(name, found, input);
        if (const auto others = users(name, kind, !input); !others.empty())
          refuse(split_.processes[others[0]].place,
                 fmt::format("the top's stream '{}' is both read and written: a stream has one direction", name));
        dataflow::port port = port_of(found[0], name);
        port.where = location(network_.files, split_.top.place);
        network_.ports.push_back(std::move(port));
        break;
      }
    }
  }

  void add_call() {
    if (lowered_.front().whole_call.fields.empty()) return;
    network_.ports.push_back(lowered_.front().whole_call);
    network_.ports.back().where = location(network_.files, split_.top.place);
  }

  void check_parameters() const {
    const std::vector<dataflow::field>& scalars = lowered_.front().whole_call.fields;
    for (const auto& [index, name] : split_.top.parameters) {
      const bool is_port = std::any_of(network_.ports.begin(), network_.ports.end(),
                                       [&, &wanted = name](const dataflow::port& port) { return port.name == wanted; });
      const bool is_scalar = std::any_of(scalars.begin(), scalars.end(),
                                         [&, &wanted = name](const dataflow::field& f) { return f.name == wanted; });
      if (!is_port && !is_scalar)
        refuse(split_.top.place, fmt::format("the stream '{}' is never read or written: remove the parameter", name));
    }
  }

  const split_top& split_;
  const std::vector<lowered_process>& lowered_;
  dataflow::network network_;
};

}  // namespace

dataflow::network join_processes(const split_top& split, const std::vector<lowered_process>& lowered,
                                 std::vector<dataflow::graph> graphs) {
  if (!split.processes.front().is_part) return dataflow::network_of(std::move(graphs.front()));
  return joiner(split, lowered, std::move(graphs)).join();
}

}  // namespace epiline::frontend
