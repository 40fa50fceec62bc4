"""Set-up blocks of the PPMC-312: curves that many bus tests load first (`Host.start(dut, *TG)`)."""

from __future__ import annotations

from cocotb_tests.ppmc312.messages import message
from openppmc.model.ppmc312.codes import Code

T1 = message(Code.INITIAL, "01 03E8 00C8 0007D0")
T2 = message(Code.INITIAL, "09 03E8 00C8 0007D0")
T3 = message(Code.INITIAL, "11 03E8 01F4 00C8 0007D0 0005DC")
T4 = message(Code.INITIAL, "11 01F4 03E8 00C8 0005DC 0007D0")
RATES = "00 06 0064 00C8 0190"
TF = ("02 03 01 01 03", RATES, "01 09 000005 000004 000003")
TG = ("02 04 01 11 03 02", RATES, "00 09 000005 000004 000003", "01 06 000006 000004")
TH = ("02 04 01 11 02 03", RATES, "00 06 000006 000004", "01 09 000005 000004 000003")
