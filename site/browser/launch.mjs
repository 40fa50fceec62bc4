// Start a headless Chromium: the one on PATH (Debian package), or else that of @sparticuz/chromium.
// If neither starts, the program prints one line and ends with exit code 3.
import { execFileSync } from "node:child_process";
import chromium from "@sparticuz/chromium";
import { chromium as playwright } from "playwright-core";

// The package's own arguments are not used, because they turn web security off, unlike a reader's browser.
async function found() {
  const options = { headless: true, args: ["--no-sandbox"], env: { ...process.env, LANG: "en_US.UTF-8" } };
  try {
    const own = execFileSync("which", ["chromium"], { encoding: "utf8" }).trim();
    return await playwright.launch({ ...options, executablePath: own });
  } catch {
    // There is no Chromium on PATH, or it does not start.
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
