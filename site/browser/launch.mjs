// Start a headless Chromium: the one on PATH (package of Debian), else that of @sparticuz/chromium.
// Without a browser the program ends with one line and exit code 3.
import { execFileSync } from "node:child_process";
import chromium from "@sparticuz/chromium";
import { chromium as playwright } from "playwright-core";

// The arguments of the package would switch web security off. The browser of a reader has it on.
async function found() {
  const options = { headless: true, args: ["--no-sandbox"], env: { ...process.env, LANG: "en_US.UTF-8" } };
  try {
    const own = execFileSync("which", ["chromium"], { encoding: "utf8" }).trim();
    return await playwright.launch({ ...options, executablePath: own });
  } catch {
    // No chromium on PATH, or it does not start.
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
