// Uses a capability, frees it, and uses it again until the bond is broken. The arguments are the
// name of the server's node and that of an interface. Says what happens, a line each; the exit
// status is 1 if something that has to come does not.
#include <functional>
#include <iostream>
#include <string>
#include <vector>

#include <bondcpp/bond.h>
#include <capabilities/CapabilityEvent.h>
#include <capabilities/EstablishBond.h>
#include <capabilities/FreeCapability.h>
#include <capabilities/GetRunningCapabilities.h>
#include <capabilities/StartCapability.h>
#include <capabilities/UseCapability.h>
#include <ros/ros.h>

namespace {

std::string interface;
std::vector<std::string> events;    // of that interface, and those of the server itself

void note(const capabilities::CapabilityEvent& event) {
  if (event.capability == interface || event.capability.empty())
    events.push_back(event.type);
}

void require(bool holds, const std::string& what) {
  std::cout << (holds ? "" : "not ") << what << std::endl;
  if (!holds) exit(1);
}

bool eventually(const std::function<bool()>& condition) {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(60.0);
  while (!condition()) {
    if (!ros::ok() || ros::WallTime::now() > end) return false;
    ros::spinOnce();
    ros::WallDuration(0.02).sleep();
  }
  return true;
}

bool isHeard(const std::string& type, unsigned count = 1) {
  unsigned found = 0;
  for (const std::string& event : events) found += event == type;
  return found >= count;
}

bool runs(const std::string& server) {
  capabilities::GetRunningCapabilities running;
  if (!ros::service::call(server + "/get_running_capabilities", running)) return false;
  for (const auto& one : running.response.running_capabilities)
    if (one.capability.capability == interface && one.pid > 0) return true;
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "capability_user");
  ros::NodeHandle node;
  const std::string server = argv[1];
  interface = argv[2];
  ros::Subscriber subscriber = node.subscribe(server + "/events", 1000, &note);

  require(ros::service::waitForService(server + "/establish_bond", 60000), "there");
  require(eventually([] { return isHeard("\"server_ready\""); }), "ready");
  require(capabilities::CapabilityEvent::SERVER_READY == "\"server_ready\"", "quoted");

  capabilities::EstablishBond establish;
  require(ros::service::call(server + "/establish_bond", establish), "given an id");
  bool formed = false;
  bond::Bond bond(server + "/bonds", establish.response.bond_id, boost::function<void()>(),
                  [&formed] { formed = true; });
  bond.start();
  require(eventually([&formed] { return formed; }), "bonded");    // it needs this thread's spins

  capabilities::UseCapability use;
  use.request.capability = interface;
  use.request.bond_id = "no such id";
  require(!ros::service::call(server + "/use_capability", use), "refused to others");
  use.request.bond_id = establish.response.bond_id;
  require(ros::service::call(server + "/use_capability", use), "used");
  require(eventually([&] { return runs(server); }), "running");
  require(eventually([] { return isHeard(capabilities::CapabilityEvent::LAUNCHED); }), "launched");

  capabilities::StartCapability start;
  start.request.capability = interface;
  start.request.preferred_provider = "no/such_provider";
  require(!ros::service::call(server + "/start_capability", start), "refused to start");

  capabilities::FreeCapability free;
  free.request.capability = interface;
  free.request.bond_id = establish.response.bond_id;
  require(ros::service::call(server + "/free_capability", free), "freed");
  require(eventually([] { return isHeard(capabilities::CapabilityEvent::TERMINATED); }),
          "terminated");
  require(!runs(server), "no longer running");
  require(!ros::service::call(server + "/free_capability", free), "refused to free it again");

  require(ros::service::call(server + "/use_capability", use), "used again");
  require(eventually([&] { return runs(server); }), "running again");
  bond.breakBond();
  require(eventually([] { return isHeard(capabilities::CapabilityEvent::TERMINATED, 2); }),
          "terminated with the bond");
  require(eventually([&] { return !runs(server); }), "gone");
  return 0;
}
