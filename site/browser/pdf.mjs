// node pdf.mjs HTML PAGE.html=NAME.pdf …: print pages of the site as PDF.
// If no browser starts, the program prints one line and ends with exit code 3.
import path from "node:path";
import { pathToFileURL } from "node:url";
import { launch } from "./launch.mjs";

const [, , html, ...jobs] = process.argv;
const view = await launch();
const page = await view.newPage({ locale: "en-US" });
for (const job of jobs) {
  const [from, to] = job.split("=");
  await page.goto(pathToFileURL(path.join(html, from)).href);
  // The PDF is read without the other pages: references to them stay as text, but without a link to a file.
  await page.evaluate(() => {
    for (const link of document.querySelectorAll("a[href]"))
      if (link.protocol === "file:" && link.pathname !== location.pathname) link.removeAttribute("href");
  });
  await page.emulateMedia({ media: "print", colorScheme: "light" });
  await page.pdf({
    path: path.join(html, to),
    format: "A4",
    printBackground: true,
    margin: { top: "16mm", bottom: "18mm", left: "14mm", right: "14mm" },
    displayHeaderFooter: true,
    headerTemplate: "<span></span>",
    footerTemplate:
      '<div style="font-size:8px;width:100%;text-align:center">OpenPPMC &nbsp; <span class="title"></span> &nbsp; <span class="pageNumber"></span> / <span class="totalPages"></span></div>',
  });
}
await view.close();
