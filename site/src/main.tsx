import { render } from "preact";
import "uplot/dist/uPlot.min.css";
import "./style.css";
import { App } from "./ui/app";
import { setBase } from "./ui/load";
import { arrive } from "./ui/state";

setBase((document.currentScript as HTMLScriptElement | null)?.src ?? "");

/** On a page without MkDocs, use the colour scheme of the system, with the names of MkDocs Material. */
function followSystem(): void {
  const { dataset } = document.body;
  if (dataset.mdColorScheme) return;
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const follow = (): void => {
    dataset.mdColorScheme = dark.matches ? "slate" : "default";
  };
  dark.addEventListener("change", follow);
  follow();
}

function begin(): void {
  followSystem();
  const root = document.getElementById("openppmc-playground");
  if (!root) return;
  root.replaceChildren();
  render(<App />, root);
  arrive(true);
  // The search of the site links to the list of statements, which is a popover.
  if (location.hash === "#statements") document.getElementById("pg-statements")?.showPopover?.();
  // A link to this page, and the buttons Back and Forward. (hashchange misses a link that is followed twice.)
  addEventListener("popstate", () => arrive());
}

if (document.readyState === "loading") document.addEventListener("DOMContentLoaded", begin);
else begin();
