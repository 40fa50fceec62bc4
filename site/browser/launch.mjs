// A Chromium without a window: the one on PATH (Debian's package), or the one in @sparticuz/chromium. If none can be
// had the program ends with one line and exit code 3.
import { execFileSync } from "node:child_process";
import chromium from "@sparticuz/chromium";
import { chromium as playwright } from "playwright-core";

// The arguments of the package switch web security off; a reader's browser has it on.
async function found() {
  const options = { headless: true, args: ["--no-sandbox"], env: { ...process.env, LANG: "en_US.UTF-8" } };
  try {
    const own = execFileSync("which", ["chromium"], { encoding: "utf8" }).trim();
    return await playwright.launch({ ...options, executablePath: own });
  } catch {
    // There is none, or it does not start.
  }
  return playwright.launch({ ...options, executablePath: await chromium.executablePath() });
}

export async function launch() {
  try {
    return await found();
  } catch (error) {
    console.error(`no browser: ${String(error.message).split("\n")[0]}`);
    process.exit(3);
  }
}
