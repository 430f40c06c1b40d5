// Tests a capability_server from outside, by its published contract alone:
//
//     contract_client SERVER FIXTURES
//
// SERVER is the absolute name of the node, FIXTURES the folder of its packages. The server has the
// parameters of server.yaml, and may be started after this program. One line for each check; exits
// with 0 only if all of them hold. "Deliberately": where this server differs from the one of old
// (doc/migration.rst).
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <future>
#include <iostream>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <bond/Status.h>
#include <bondcpp/bond.h>
#include <capabilities/CapabilityEvent.h>
#include <capabilities/EstablishBond.h>
#include <capabilities/FreeCapability.h>
#include <capabilities/GetCapabilitySpec.h>
#include <capabilities/GetCapabilitySpecs.h>
#include <capabilities/GetInterfaces.h>
#include <capabilities/GetNodeletManagerName.h>
#include <capabilities/GetProviders.h>
#include <capabilities/GetRemappings.h>
#include <capabilities/GetRunningCapabilities.h>
#include <capabilities/GetSemanticInterfaces.h>
#include <capabilities/StartCapability.h>
#include <capabilities/StopCapability.h>
#include <capabilities/UseCapability.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <std_srvs/Empty.h>

namespace {

using namespace capabilities;
using namespace std::chrono_literals;
using std::string;
using Names = std::vector<string>;
using Clock = std::chrono::steady_clock;
using Result = StartCapability::Response;

string server;
std::filesystem::path fixtures;
int checks = 0, failures = 0;

void check(const string& what, bool holds, const string& seen = "") {
  ++checks;
  failures += !holds;
  std::cout << (holds ? "ok      " : "FAILED  ") << what << (holds || seen.empty() ? "" : "\n        seen: " + seen)
            << std::endl;
}
string text(const Names& names) {
  string all;
  for (const auto& name : names) all += (all.empty() ? "" : ", ") + name;
  return "[" + all + "]";
}
void equal(const string& what, const Names& seen, const Names& expected) { check(what, seen == expected, text(seen)); }

Names sorted(Names names) {
  std::sort(names.begin(), names.end());
  return names;
}
template <class Condition>
bool until(Condition condition, std::chrono::seconds timeout = 20s) {
  for (const auto end = Clock::now() + timeout; !condition(); std::this_thread::sleep_for(20ms))
    if (Clock::now() > end) return false;
  return true;
}
void took(const string& what, Clock::time_point begin, double least) {
  const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  check(what + " (" + std::to_string(seconds).substr(0, 5) + " s)", least <= seconds);
}

// ---- services

// roscpp does not hand the text of a service's error to the caller, but logs it in the caller's thread.
struct ErrorText : ros::console::LogAppender {
  void log(ros::console::Level, const char* message, const char*, const char*, int) override {
    static const string marker = "responded with an error: ";
    if (const char* found = std::strstr(message, marker.c_str())) last = found + marker.size();
  }
  static thread_local string last;
};
thread_local string ErrorText::last;

template <class Service>
struct Reply : Service::Response {
  bool ok;
  string error;
};
template <class Service, class... Fields>
Reply<Service> call(const string& name, const Fields&... fields) {
  uint8_t wire[1000];    // where a request is its fields, one after the other
  ros::serialization::OStream out(wire, sizeof wire);
  (out.next(fields), ...);
  Service service;
  ros::serialization::IStream(wire, sizeof wire).next(service.request);
  ErrorText::last.clear();
  const bool ok = ros::service::call(server + "/" + name, service);
  return {service.response, ok, ErrorText::last};
}
auto start(const string& capability, const string& provider = "") {
  return call<StartCapability>("start_capability", capability, provider);
}
auto stop(const string& capability) { return call<StopCapability>("stop_capability", capability); }
auto use(const string& capability, const string& bond, const string& provider = "") {
  return call<UseCapability>("use_capability", capability, provider, bond);
}
auto release(const string& capability, const string& bond) {
  return call<FreeCapability>("free_capability", capability, bond);
}
auto interfaces() { return sorted(call<GetInterfaces>("get_interfaces").interfaces); }
auto semantic(const string& interface) { return call<GetSemanticInterfaces>("get_semantic_interfaces", interface); }
auto providers(const string& interface, bool include_semantic = false) {
  return call<GetProviders>("get_providers", interface, include_semantic);
}
auto spec(const string& name) { return call<GetCapabilitySpec>("get_capability_spec", name); }
auto remappings(const string& name) { return call<GetRemappings>("get_remappings", name); }
bool reload() { return call<std_srvs::Empty>("reload_capabilities").ok; }

auto running() {
  const auto reply = call<GetRunningCapabilities>("get_running_capabilities");
  if (!reply.ok) throw std::runtime_error("get_running_capabilities: " + reply.error);
  std::map<string, RunningCapability> found;
  for (const auto& one : reply.running_capabilities) found[one.capability.capability] = one;
  return found;
}
bool runs(const string& capability) { return running().count(capability) > 0; }
bool comes(const string& capability) { return until([&] { return runs(capability); }); }
bool goes(const string& capability) { return until([&] { return !remappings(capability).ok; }); }    // in any state
bool up(const string& capability) { return start(capability).ok && comes(capability); }
void down() {
  for (auto now = running(); !now.empty(); now = running()) stop(now.begin()->first);
}

template <class Service>
void fails(const string& what, const Reply<Service>& reply, const string& expected) {
  const bool holds = !reply.error.rfind("error processing request: ", 0) && reply.error.find(expected) != string::npos;
  check(what + ": " + expected, !reply.ok && holds, reply.ok ? "no error" : reply.error);
}

// ---- events and bonds

class Events {
 public:
  Events() : subscriber_(ros::NodeHandle().subscribe(server + "/events", 1000, &Events::receive, this)) {}

  // Checks that these launches and ends have come since the last time, in this order, and no others.
  void expect(const string& what, const Names& expected) {
    until([&] { return since().size() >= expected.size(); });
    equal("events of " + what, skip(), expected);
  }
  Names skip() {
    std::this_thread::sleep_for(500ms);
    const auto seen = since();
    begin_ += seen.size();
    return seen;
  }
  std::vector<CapabilityEvent> all() {
    const std::lock_guard lock(mutex_);
    return all_;
  }

 private:
  void receive(const CapabilityEvent& event) {
    const std::lock_guard lock(mutex_);
    all_.push_back(event);
  }
  Names since() {
    Names names;
    for (const auto& event : all())
      if (event.capability.rfind("!!", 0) && (event.type == event.LAUNCHED || event.type == event.TERMINATED))
        names.push_back((event.type == event.LAUNCHED ? "launched " : "terminated ") + event.capability);
    return {names.begin() + begin_, names.end()};
  }

  std::mutex mutex_;
  std::vector<CapabilityEvent> all_;
  size_t begin_ = 0;
  ros::Subscriber subscriber_;
};

// Uses capabilities by a bond, which has a thread of its own so that it can hang.
class User {
 public:
  explicit User(bool form = true) {
    bond_.setCallbackQueue(&queue_);
    spinner_.start();
    if (form) bond_.start();
    formed = form && bond_.waitUntilFormed(ros::WallDuration(10));
  }
  ~User() { spinner_.start(); }
  void leave() { bond_.breakBond(); }
  void hang() { spinner_.stop(); }
  auto use(const string& capability, const string& provider = "") { return ::use(capability, id, provider); }
  auto release(const string& capability) { return ::release(capability, id); }

  const string id = call<EstablishBond>("establish_bond").bond_id;
  bool formed;

 private:
  ros::CallbackQueue queue_;
  ros::AsyncSpinner spinner_{1, &queue_};
  bond::Bond bond_{server + "/bonds", id};
};

// ---- the contract

template <class... Messages>
Names messages() { return {ros::message_traits::md5sum<Messages>()...}; }
template <class... Services>
Names services() { return {ros::service_traits::md5sum<Services>()...}; }

void test_messages() {
  equal("MD5 of messages",
        messages<Capability, CapabilityEvent, CapabilitySpec, Remapping, RunningCapability, bond::Status>(),
        {"05f9dd41875315c324efdf915b0e33a9", "5a0d82ee1a8e7a5d0b058f0b20305b18", "410c606586817322b7ad85c73e4a4c9f",
         "cf57fdc6617a881a88c16e768132149c", "f97e2b23f907893008679ba2ff64fafc", "eacc84bf5d65b6777d4c50f463dfb9c8"});
  equal("MD5 of services",
        services<StartCapability, StopCapability, UseCapability, FreeCapability, EstablishBond, GetInterfaces,
                 GetSemanticInterfaces, GetProviders, GetCapabilitySpecs, GetCapabilitySpec, GetRunningCapabilities,
                 GetNodeletManagerName, GetRemappings>(),
        {"736529805295984ddb5ab334f50db336", "a38f2dfa23de9298b61bf01d2624e1cc", "d12bf387dc5fcdd1fb836406b703a384",
         "a428ffea976541636efe63c8605fd3ec", "5dec67991af973eddfa86dc20c3faef0", "1e08367cf1ecdb90202f4711ad4955a7",
         "2b0794f4415a7884148fc328bd6bc7d3", "d7193b8cbc296323bd5043e53d4b02d8", "70274a8d27cd41f8e0754661d97168f8",
         "d32f85e5386368c45ff17463743a70f8", "e8e5cf68c34711ffaa719728f34ea7a3", "014bb50d87c6c69df1cbae3d5439041f",
         "e08cc3bd533b5554ccb1906769ad809b"});
  using Event = CapabilityEvent;
  equal("constants of events", {Event::LAUNCHED, Event::STOPPED, Event::TERMINATED, Event::SERVER_READY},
        Names{"\"launched\"", "\"stopped\"", "\"terminated\"", "\"server_ready\""});
  check("constants of results", Result::RESULT_SUCCESS == 0 && Result::RESULT_CURRENTLY_STARTING == 1 &&
                                    Result::RESULT_CURRENTLY_RUNNING == 2 && Result::RESULT_CURRENTLY_STOPPING == 3);
}

void test_specs() {
  equal("get_interfaces", interfaces(), {"bot/Base", "bot/Brief", "bot/Bumper", "bot/Camera", "bot/Crane", "bot/Idle",
        "bot/Lost", "bot/Plain", "bot/Range", "bot/Slow", "bot/Speech", "bot/Stubborn"});
  equal("get_semantic_interfaces", sorted(semantic("").semantic_interfaces), {"bot/FrontCamera", "bot/SecretDoor"});
  equal("get_semantic_interfaces of one", semantic("bot/Camera").semantic_interfaces, {"bot/FrontCamera"});
  check("get_semantic_interfaces of none", semantic("bot/No").ok && semantic("bot/No").semantic_interfaces.empty());
  const auto all = providers(""), base = providers("bot/Base"), camera = providers("bot/Camera");
  check("get_providers", all.providers.size() == 14, text(all.providers));
  equal("get_providers of one", sorted(base.providers), {"bot/base", "bot/base_alt"});
  equal("without semantic ones", camera.providers, {"bot/usb_camera"});
  equal("with semantic ones", sorted(providers("bot/Camera", true).providers), {"bot/front_camera", "bot/usb_camera"});
  equal("default of all, by parameter, the only one",
        {all.default_provider, base.default_provider, camera.default_provider},
        Names{"", "bot/base", "bot/usb_camera"});
  const auto speech = providers("bot/Speech");
  check("without a default there are providers, deliberately", speech.ok && speech.default_provider.empty() &&
        speech.providers.size() == 2);
  for (const string name : {"bot/No", "bot/Secret", "hidden/Hidden"}) {    // unknown, filtered by name and by package
    fails("get_providers", providers(name), "Capability Interface '" + name + "' not found.");
    fails("get_capability_spec", spec(name), "Could not find requested spec '" + name + "'");
    fails("start_capability", start(name), "Capability '" + name + "' not found.");
  }
  std::map<string, int> kinds;
  for (const auto& one : call<GetCapabilitySpecs>("get_capability_specs").capability_specs)
    ++kinds[one.package + " " + one.type];
  check("get_capability_specs", kinds == std::map<string, int>{{"bot capability_interface", 12},
        {"bot semantic_capability_interface", 2}, {"bot capability_provider", 14}});
  std::ifstream file(fixtures / "bot/interfaces/Base.yaml");
  const string raw(std::istreambuf_iterator<char>(file), {});    // has a key that no specification knows
  const auto one = spec("bot/Base").capability_spec, front = spec("bot/FrontCamera").capability_spec;
  equal("get_capability_spec", {one.package, one.type, one.default_provider, one.content, front.type},
        Names{"bot", "capability_interface", "bot/base", raw, "semantic_capability_interface"});
  check("providers have a spec, deliberately", spec("bot/base").capability_spec.type == "capability_provider");
}

void test_start_and_stop(Events& events) {
  fails("start without a default", start("bot/Speech"), "'bot/Speech'");
  fails("start", start("bot/Camera", "bot/base"),
        "Capability Provider 'bot/base' not found for Capability 'bot/Camera'");
  fails("start without a dependency", start("bot/Lost"), "Capability Provider 'bot/no_such_range' not found");
  fails("stop what does not run", stop("bot/Base"), "No Capability 'bot/Base' running");
  check("nothing runs after errors", running().empty());

  check("start", start("bot/Camera").result == Result::RESULT_SUCCESS && comes("bot/Camera"));
  check("start what runs", start("bot/Camera").result == Result::RESULT_CURRENTLY_RUNNING);
  events.expect("a start: a dependency first", {"launched bot/Base", "launched bot/Camera"});
  auto now = running();
  const auto &base = now["bot/Base"], &camera = now["bot/Camera"];
  const auto above = base.dependent_capabilities;
  equal("get_running_capabilities",
        {camera.started_by, base.started_by, camera.capability.provider, base.capability.provider},
        Names{"user service call", "bot/usb_camera", "bot/usb_camera", "bot/base"});
  check("dependents", above.size() == 1 && above[0].capability == "bot/Camera");
  check("its pid is that of the event", camera.pid > 0 && camera.pid == events.all().back().pid);
  check("stop", stop("bot/Base").successful && running().empty() && kill(camera.pid, 0) && kill(base.pid, 0));
  events.expect("a stop: a dependent first", {"terminated bot/Camera", "terminated bot/Base"});
  check("a dependency goes after its last dependent", up("bot/Camera") && stop("bot/Camera").ok && goes("bot/Base"));
  check("start what runs as a dependency",
        up("bot/Camera") && start("bot/Base").result == Result::RESULT_CURRENTLY_RUNNING && stop("bot/Camera").ok);
  check("this counts as a start, deliberately: it runs on", goes("bot/Camera") && runs("bot/Base"));
  down();
  start("bot/Camera", "bot/front_camera");
  check("with the provider of a semantic interface it has that name", comes("bot/FrontCamera") && !runs("bot/Camera"));
  down();
  events.skip();
  check("what ends of itself goes", up("bot/Brief") && goes("bot/Brief"));
  events.expect("what ends of itself", {"launched bot/Brief", "terminated bot/Brief"});

  check("a node that takes 4 s to die",
        up("bot/Slow") && until([] { return std::filesystem::exists(fixtures / "bot/nodes/slow_is_up"); }));
  const auto begin = Clock::now();
  auto stopping = std::async(std::launch::async, [] { return stop("bot/Slow").successful; });
  std::this_thread::sleep_for(1s);
  check("start what is stopping", start("bot/Slow").result == Result::RESULT_CURRENTLY_STOPPING && !runs("bot/Slow"));
  check("start what has to wait for it", start("bot/Crane").result == Result::RESULT_SUCCESS && !runs("bot/Crane"));
  check("start what is starting", start("bot/Crane").result == Result::RESULT_CURRENTLY_STARTING);
  check("what is in any state has remappings", remappings("bot/Slow").ok && remappings("bot/crane").ok);
  check("stop waits", stopping.get());
  took("until it is dead", begin, 4);
  std::this_thread::sleep_for(1s);
  down();
  events.skip();
}

void test_bonds(Events& events) {
  User one, two;
  check("bonds form, each with its own id", one.formed && two.formed && one.id != two.id);
  fails("use", use("bot/Camera", "x"), "Invalid bond_id given to ~use_capability: 'x'");
  fails("use", one.use("bot/No"), "Capability 'bot/No' not found.");
  check("use, and by another", one.use("bot/Camera").ok && two.use("bot/Camera").ok && comes("bot/Camera"));
  check("use again", one.use("bot/Camera").ok);
  fails("use", two.use("bot/Base", "bot/base_alt"), "is already running with provider 'bot/base'");
  fails("free", two.release("bot/Base"),
        "Given bond_id '" + two.id + "' not associated with given capability 'bot/Base'");
  fails("free", one.release("bot/Plain"), "Cannot free Capability 'bot/Plain', because it is not running");
  check("free twice", one.release("bot/Camera").ok && one.release("bot/Camera").ok && runs("bot/Camera"));
  fails("free once too often", one.release("bot/Camera"), "not associated with given capability 'bot/Camera'");
  check("the last free stops it at once", two.release("bot/Camera").ok && !runs("bot/Camera") && goes("bot/Base"));
  events.expect("uses", {"launched bot/Base", "launched bot/Camera", "terminated bot/Camera", "terminated bot/Base"});
  check("a start outlives the last free, deliberately",
        up("bot/Plain") && one.use("bot/Plain").ok && one.release("bot/Plain").ok && runs("bot/Plain"));
  down();
  check("what another used capability depends on outlives it too, deliberately", two.use("bot/Camera").ok &&
        one.use("bot/Base").ok && comes("bot/Camera") && one.release("bot/Base").ok && runs("bot/Base"));
  down();

  check("two users", one.use("bot/Plain").ok && one.use("bot/Camera").ok && two.use("bot/Camera").ok);
  check("of two", comes("bot/Plain") && comes("bot/Camera"));
  auto begin = Clock::now();
  one.leave();
  check("a bond that is broken on purpose frees", goes("bot/Plain") && runs("bot/Camera"));
  begin = Clock::now();
  two.hang();
  check("a bond without heartbeat frees", goes("bot/Camera"));
  took("after 4 s", begin, 3);
  begin = Clock::now();
  User absent(false);
  check("a bond that never forms frees", absent.use("bot/Plain").ok && comes("bot/Plain") && goes("bot/Plain"));
  took("after 10 s", begin, 9);
  User last;
  check("start and use", up("bot/Plain") && last.use("bot/Plain").ok && last.use("bot/Range").ok && comes("bot/Range"));
  last.leave();
  check("a start outlives the last bond, deliberately", goes("bot/Range") && runs("bot/Plain"));
  down();
}

void test_remappings() {
  const auto pairs = [](const std::vector<Remapping>& remappings) {
    Names all;
    for (const auto& one : remappings) all.push_back(one.key + " -> " + one.value);
    return text(all);
  };
  fails("get_remappings", remappings("bot/Range"),
        "Spec 'bot/Range' is neither a running Interface nor a running Provider.");
  check("get_remappings at once", start("bot/Bumper").ok && remappings("bot/Bumper").ok && comes("bot/Bumper"));
  check("get_remappings below", pairs(remappings("bot/Range").topics) == "[distance -> robot/front/distance]");
  for (const auto& above : {remappings("bot/Bumper"), remappings("bot/bumper")})
    equal("get_remappings above, by interface and by provider, follows chains",
          {pairs(above.topics), pairs(above.services), pairs(above.actions), pairs(above.parameters)},
          Names{"[front/distance -> robot/front/distance]", "[calibrate -> robot/front/calibrate]",
                "[press -> robot/press]", "[max_range -> robot/front/max_range]"});
  down();
}

void test_reload() {
  const auto before = interfaces();
  const auto absent = fixtures / "late/package.xml.absent", present = fixtures / "late/package.xml";
  std::filesystem::rename(absent, present);
  check("a new package is found by reload_capabilities, and not before",
        interfaces() == before && reload() && interfaces().size() == before.size() + 1);
  check("defaults are determined again, deliberately",
        spec("late/Late").capability_spec.default_provider == "late/late");
  check("what is new can be started", start("late/Late", "late/late").ok && comes("late/Late"));
  down();
  std::filesystem::rename(present, absent);
  const auto reply = call<std_srvs::Empty>("reload_capabilities");
  const auto after = interfaces();
  check("reload_capabilities forgets it", reply.ok && after == before, reply.error + text(after));
}

void test_nodelet_manager() {
  const string name = call<GetNodeletManagerName>("get_nodelet_manager_name").nodelet_manager_name;
  Names nodes;
  ros::master::getNodes(nodes);
  check("get_nodelet_manager_name", name == server + "_nodelet_manager", name);
  check("it is a node", std::count(nodes.begin(), nodes.end(), name) == 1);
}

void test_all_events(Events& events) {
  int ready = 0, wrong = 0;
  std::map<string, int> stopped;    // deliberately published, before the end of what was asked to stop
  bool in_order = true;
  for (const auto& event : events.all()) {
    const bool empty = event.capability.empty() && event.provider.empty() && !event.pid && event.header.stamp.isZero();
    const bool full = !event.provider.empty() && event.pid > 0 && !event.header.stamp.isZero();
    ready += event.type == event.SERVER_READY;
    stopped[event.capability] += event.type == event.STOPPED;
    if (event.type == event.TERMINATED && event.capability != "bot/Brief") in_order &= stopped[event.capability]-- > 0;
    wrong += event.type == event.SERVER_READY ? !empty : !full;
  }
  check("server_ready came once or was missed (" + std::to_string(ready) + ")", ready <= 1);
  check("all events have the fields of their type", !wrong, std::to_string(wrong) + " wrong");
  check("stopped comes before terminated, deliberately", in_order);
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "contract_client");
  if (argc != 3) return 2;
  server = argv[1];
  fixtures = argv[2];
  auto error_text = new ErrorText;  // for good: to take it back frees it twice in rosconsole 1.13
  ros::NodeHandle node;
  ros::console::register_appender(error_text);
  ros::AsyncSpinner spinner(2);
  spinner.start();
  Events events;
  for (const auto name : {"/establish_bond", "/get_remappings", "/reload_capabilities"})
    check(string(name) + " is there", ros::service::waitForService(server + name, ros::Duration(60)));
  test_messages();
  test_specs();
  events.skip();
  test_start_and_stop(events);
  test_bonds(events);
  test_remappings();
  test_reload();
  test_nodelet_manager();
  test_all_events(events);
  std::cout << checks - failures << " of " << checks << " checks hold" << std::endl;
  return failures ? 1 : 0;
}
