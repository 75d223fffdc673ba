#include "board/engines.hpp"

#include <fmt/format.h>

#include <chrono>

#include "board/board_order.hpp"
#include "csim/frame_beats.hpp"

namespace epiline::board {
namespace {

class board_engine final : public eval::engine {
 public:
  explicit board_engine(const eval::design_description& design) : design_(design) {}

  eval::match_result match(const eval::match_request& request, const eval::run_options& options) override {
    if (options.port.empty()) {
      throw eval::engine_error(
          "engine board needs --port, the serial port of the board, for example --port /dev/ttyUSB0");
    }
    try {
      serial_port port(options.port, options.baud);
      board_link link(port, {.patience = std::chrono::milliseconds(options.patience_milliseconds)});
      const board_identity identity = link.identify();
      if (identity.design != design_.name) {
        throw eval::engine_error(fmt::format(
            "the board at {} holds {} (design {}), not design {}: load that one's bitstream, or say --design {}",
            options.port, identity.core, identity.design, design_.name, identity.design));
      }
      check_fits(identity, request, options.port);
      const int width = request.left.width;
      const int height = request.left.height;
      const auto start = std::chrono::steady_clock::now();
      const bytes results =
          link.run(frame_order(identity, request), result_bytes(identity, width, height), options.progress);
      eval::match_result result;
      result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      result.map = map_of_results(identity, results, width, height);
      const link_statistics& line = link.statistics();
      result.note = fmt::format("{} on {}; {} packets, {} sent again, {} reads repeated, {} + {} damaged, {} restarts",
                                identity.core, identity.board, line.data_packets, line.resent_packets,
                                line.repeated_reads, line.bad_packets_of_board, line.bad_packets, line.restarts);
      return result;
    } catch (const link_error& error) {
      throw eval::engine_error(error.what());
    } catch (const port_error& error) {
      throw eval::engine_error(error.what());
    } catch (const csim::malformed_frame& error) {
      throw eval::engine_error(
          fmt::format("what the board at {} sent is no disparity map: {}", options.port, error.what()));
    }
  }

 private:
  const eval::design_description& design_;
};

}  // namespace

void register_engines(eval::engine_registry& registry) {
  for (const auto& design : eval::all_designs()) {
    registry.add({std::string(design.name), "board", "a real device at the serial port --port",
                  [](const eval::design_description& made_for) { return std::make_unique<board_engine>(made_for); }});
  }
}

}  // namespace epiline::board
