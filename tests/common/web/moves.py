"""A short move for each part of the playground."""

from __future__ import annotations

from scripts.site.sessions import sessions

BYTES = "c 0A d C7 d 31 d 64 d 00 c 43 d 63 d 00 d 00"
"""A move of 100 pulses."""
MOVES = {
    "ppmc104": f"{BYTES} idle wait 2ms",
    "ppmc2104": f"{BYTES.replace('0A', '02').replace('c 43', 'p 00 c 43')} idle wait 2ms",
    "stmc": f"{BYTES} idle wait 2ms",
    "ppmc312": sessions("ppmc312")[0].text.split("wait 1540ms")[0] + "wait 200ms",
    "ppmc312-serial": sessions("ppmc312-serial")[1].text,
    "pmc006": sessions("pmc006")[0].text,
    "bank": f"axis 0 {BYTES}\naxis 3 {BYTES} idle wait 2ms",
}
