// The study behind `gearshift contact`: ripple of a wall under a push, energy of impacts, stiffness in motion.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/lab/contact/contact_campaign.h"

namespace gearshift::lab {

struct ContactQuestion {
  std::string device;  // display name
  Campaign campaign;
};

struct ContactAnswer {
  haptics::AdmittedTuning admitted;
  std::vector<HandOutcome> hands;
  double ripple_p95 = 0.0;  // [m]
  double softened = 0.0;    // [1] fraction of the runs in which the reversal limiter softened the wall
  double saturated = 0.0;   // [1] fraction of the runs in which the motors were at their limit at the end
  double stopped = 0.0;     // [1] fraction of the runs in which the guard switched the force off
  // Impacts and motion are measured without jitter, plant error and the loop's damping outside the wall.
  ImpactPlan impacts;
  ImpactEnergy impact;
  std::vector<DynamicStiffness> dynamic;  // in a gripping hand
};

// Throws std::invalid_argument if no wall can be used on this device. `progress` is called with the completed fraction.
ContactAnswer measure_contact(const ContactQuestion& question, const std::function<void(double)>& progress);

std::string contact_text(const ContactQuestion& question, const ContactAnswer& answer);
std::string contact_json(const ContactQuestion& question, const ContactAnswer& answer);
// A complete SVG document: Re Z over the wall's stiffness and the damping Im Z / w, against frequency.
std::string contact_svg(const ContactQuestion& question, const ContactAnswer& answer);

}  // namespace gearshift::lab
