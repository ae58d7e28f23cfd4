// A stability campaign as tables and as JSON.
#pragma once

#include <string>

#include "tests/bench/campaign/campaign_summary.h"

namespace gearshift {

std::string campaign_text(const CampaignSummary& summary);  // Markdown
// program: that drove it, and its commit.
std::string campaign_json(const CampaignSummary& summary, const std::string& program);

// One case: what was drawn, and every law.
std::string case_text(const CampaignCase& drawn, const CaseOutcome& outcome);

}  // namespace gearshift
