"""The conclusion of a machine's report."""

WORDS = {
    "motion": "**Motion.**",
    "stroke": "The stroke of {subject} is {value}.",
    "swing_angle": "The swing angle of {subject} is {value}.",
    "ratio": "The slow stroke of {subject} takes {ratio} times as long as the fast one (quick-return ratio K).",
    "no_ratio": "Both strokes of {subject} take the same time (quick-return ratio K = 1).",
    "rates": "The velocity of {subject} is at most {velocity} (at q = {first}), its acceleration at most "
    "{acceleration} (at q = {second}).",
    "rates_turning": "The angular velocity of {subject} is at most {velocity} (at q = {first}), its angular "
    "acceleration at most {acceleration} (at q = {second}).",
    "partly": "The values hold for the part of the input's range in which the machine can be assembled.",
    "transmission": "**Transmission of force.**",
    "angle_above": "The transmission angle is at least {value} (group {subject}, at q = {at}) and so keeps the "
    "recommended limit of {limit}.",
    "angle_below": "The transmission angle falls to {value} (group {subject}, at q = {at}), below the "
    "recommended {limit}.",
    "away": "No group comes close to a singular position: the distance from it is at least {value} (group "
    "{subject}, at q = {at}; 1 at best, 0 where singular).",
    "close": "Group {subject} comes close to a singular position at q = {at} (distance from it {value}; 1 at "
    "best, 0 where singular): forces grow very large there.",
    "limits": "**Recommended limits.**",
    "all_met": "All {count} values that have a recommended limit keep it.",
    "not_met": "Of {count} values that have a recommended limit {broken} do not keep it:",
    "forces": "**Forces.**",
    "largest_reaction": "The largest joint force is {value} (joint {joints}, at q = {at}).",
    "largest_reaction_rest": "The largest joint force is {value} (joint {joints}).",
    "torque": "Driver {driver} must supply a torque of at most {peak} (at q = {at}), {mean} on average and "
    "{rms} as root mean square.",
    "only_torque": "The driver must supply a torque of at most {peak} (at q = {at}), {mean} on average and "
    "{rms} as root mean square.",
    "force": "Driver {driver} must supply a force of at most {peak} (at q = {at}), {mean} on average and "
    "{rms} as root mean square.",
    "only_force": "The driver must supply a force of at most {peak} (at q = {at}), {mean} on average and "
    "{rms} as root mean square.",
    "peak_to_mean": "The peak is {ratio} times the mean.",
    "shaking": "The largest shaking force on the frame is {value} (at q = {at}).",
    "flywheel": "**Flywheel.**",
    "stretch": "What governs the flywheel is the stretch from q = {low}, where the input turns slowest, on to "
    "q = {high}, where it turns fastest: there the energy excess grows by {energy}.",
    "needed": "For δ = {fluctuation} the input shaft needs a flywheel of {inertia} ({formula} by the formula).",
    "own": "Without a flywheel δ would be {own} by the formula.",
    "none_needed": "For δ = {fluctuation} no flywheel is needed: the machine's own inertia is enough.",
    "changes": "**What a designer would change.**",
    "longer": "longer",
    "shorter": "shorter",
    "limit_change": "Among the link lengths {dimension} has most influence on the {metric}: 1 % {way} would "
    "bring it from {value} to about {better}.",
    "torque_change": "Among the link lengths {dimension} has most influence on the {metric}: 1 % {way} would "
    "lower it from {value} to about {better}.",
    "side_effect": "The travel of {output} would then change by {percent} %.",
    "first_order": "These figures are of first order, from the exact "
    "derivatives at the present dimensions; what else is asked of the machine is to be checked anew.",
    "nothing": "there are no results of a motion or of forces to conclude from",
    "joint_list": ", ",
    "between": "{first} {second}",
}
