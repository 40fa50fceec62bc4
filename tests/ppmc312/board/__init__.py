"""The PPMC-312's virtual boards, behind the bridge and on a line."""
