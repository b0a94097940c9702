#include "src/app/machine_load.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <sstream>

namespace barchan {

std::optional<double> seconds_of_all(const std::string& proc_stat, double ticks_per_second) {
  // "cpu  user nice system idle iowait irq softirq steal ...", in ticks
  std::istringstream line(proc_stat.substr(0, proc_stat.find('\n')));
  std::string name;
  double user, nice, system, idle, iowait, irq, softirq, steal;
  if (!(line >> name >> user >> nice >> system >> idle >> iowait >> irq >> softirq >> steal))
    return {};
  if (name != "cpu" || ticks_per_second <= 0) return {};
  return (user + nice + system + irq + softirq + steal) / ticks_per_second;
}

std::optional<ProcessorSeconds> processor_seconds() {
  std::ifstream file("/proc/stat");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto of_all = seconds_of_all(text, static_cast<double>(sysconf(_SC_CLK_TCK)));
  rusage own{};
  if (!of_all || getrusage(RUSAGE_SELF, &own) != 0) return {};
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return ProcessorSeconds{*of_all, seconds(own.ru_utime) + seconds(own.ru_stime),
                          std::chrono::duration<double>(now).count()};
}

double cores_of_others(const ProcessorSeconds& before, const ProcessorSeconds& after) {
  const double wall = after.wall - before.wall;
  const double others = (after.of_all - before.of_all) - (after.own - before.own);
  return wall > 0 ? std::max(0.0, others / wall) : 0.0;
}

}  // namespace barchan
