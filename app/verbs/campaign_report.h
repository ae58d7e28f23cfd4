// Formats the results of a stability campaign as tables and as JSON.
#pragma once

#include <string>

#include "app/lab/campaign/campaign_summary.h"

namespace gearshift::verbs {

std::string campaign_text(const lab::CampaignSummary& summary);  // Markdown
// `program`: name, version and commit of the program that ran the campaign.
std::string campaign_json(const lab::CampaignSummary& summary, const std::string& program);

// Describes one case: its randomly drawn parameters and the result of every law.
std::string case_text(const lab::CampaignCase& drawn, const lab::CaseOutcome& outcome);

}  // namespace gearshift::verbs
