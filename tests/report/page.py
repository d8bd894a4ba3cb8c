"""Opens a report in a headless Chromium and uses it: nothing is asked of a network, nothing is complained of, the
animation plays, curves and animation follow each other, and it fits a telephone. Saves pictures.

page.py PROGRAM FOLDER: makes its runs with the program, in the folder. Exit code 77: there is no browser."""

import json
import pathlib
import subprocess
import sys
import time

SKIPPED = 77
try:
    from selenium import webdriver
    from selenium.common.exceptions import WebDriverException
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
except ImportError:
    print("skipped: python3-selenium is not installed")
    sys.exit(SKIPPED)

SCENE = {
    "talus": 1,
    "title": "two blocks on a slab",
    "gravity": [0, -10],
    "materials": {"rock": {"density": 2000, "model": "linear_elastic", "young_modulus": 1e8, "poisson_ratio": 0.2}},
    "cover": {"model": "block"},
    "contact": {"model": "overlap_area"},
    "interfaces": [{"between": ["*", "*"], "normal_stiffness": 1e8, "tangential_stiffness": 1e8,
                    "friction_angle": 20, "normal_damping": 0.3, "tangential_damping": 0.3}],
    "bodies": [
        {"name": "slab", "polygon": [[-3, -1], [9, -1], [9, 0], [-3, 0]], "material": "rock", "fixed": True},
        {"name": "a", "polygon": [[0, 0], [1, 0], [1, 1], [0, 1]], "material": "rock", "velocity": [5, 0]},
        {"name": "b", "polygon": [[4, 0.2], [5, 0.2], [5, 1.2], [4, 1.2]], "material": "rock"}],
    "monitors": [{"name": "a", "body": "a"}, {"name": "b", "body": "b"}],
    "time": {"end": 1.5},
    "output": {"history": 0.01, "frames": 0.02},
}


def browser(width, height, scheme, phone=False):
    options = webdriver.ChromeOptions()
    for word in ("--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", f"--window-size={width},{height}"):
        options.add_argument(word)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    driver = webdriver.Chrome(options=options)
    driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": scheme}]})
    if phone:
        driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                               {"width": width, "height": height, "deviceScaleFactor": 2, "mobile": True})
    return driver


def wait_for(come, words):
    for _ in range(200):
        if come():
            return
        time.sleep(0.05)
    raise AssertionError(words)


def open_page(driver, page):
    driver.get(page.as_uri())
    wait_for(lambda: driver.execute_script("return document.documentElement.dataset.ready"), "the page does not get ready")


def check_quiet(driver, page):
    complaints = driver.get_log("browser")
    assert not complaints, complaints
    messages = (json.loads(entry["message"])["message"] for entry in driver.get_log("performance"))
    asked = [m["params"]["request"]["url"] for m in messages if m["method"] == "Network.requestWillBeSent"]
    assert all(url == page.as_uri() or url.startswith("data:") for url in asked), asked


def check_phone(phone, page):
    check_quiet(phone, page)
    width, scrolled = phone.execute_script("return [window.innerWidth, document.documentElement.scrollWidth]")
    assert scrolled <= width, f"the page is {scrolled} wide on a screen of {width}"
    assert phone.execute_script("return getComputedStyle(document.body).backgroundColor") != "rgb(245, 247, 249)", "not dark"


def shown_time(driver):
    return driver.execute_script("return talus.shown.time")


def painted(driver):
    """How many points of the canvas have a colour: read from a copy, since the browser complains of a canvas that is
    read twice, which is for this question to bear and not for the page."""
    return driver.execute_script(
        "const c = document.getElementById('canvas'), copy = new OffscreenCanvas(c.width, c.height);"
        "const points = copy.getContext('2d', {willReadFrequently: true});"
        "points.drawImage(c, 0, 0);"
        "return points.getImageData(0, 0, c.width, c.height).data.filter((v, i) => i % 4 === 3 && v > 0).length")


def check_use(driver, charts):
    titles = [card.get_attribute("data-chart") for card in driver.find_elements(By.CSS_SELECTOR, "[data-chart]")]
    assert titles[0] == "speed" and all(title in titles for title in charts), titles
    wait_for(lambda: painted(driver) > 1000, "there is no picture")
    before = driver.find_element(By.ID, "canvas").screenshot_as_png
    driver.find_element(By.ID, "play").click()
    wait_for(lambda: shown_time(driver) > 0, "it does not play")
    if driver.execute_script("return talus.shown.playing"):
        driver.find_element(By.ID, "play").click()
    assert driver.find_element(By.ID, "canvas").screenshot_as_png != before, "it plays, but the picture stands"
    # Over the middle of the first chart the animation shows the middle of the run.
    chart = driver.find_element(By.CSS_SELECTOR, ".chart")
    end = driver.execute_script("return talus.shown.end")

    def follows():
        ActionChains(driver).move_to_element_with_offset(chart, 0, 10).move_to_element(chart).perform()
        return 0.3 * end < shown_time(driver) < 0.7 * end

    wait_for(follows, "the animation does not follow the chart")
    assert "t " in driver.find_element(By.CSS_SELECTOR, ".chart-legend").text
    # The slider moves what the charts select.
    driver.execute_script("const s = document.getElementById('slider'); s.value = 1000; s.dispatchEvent(new Event('input'))")
    assert abs(shown_time(driver) - end) < 1e-9
    row = driver.execute_script("const g = talus.charts[0]; return g.rows[g.graph.getSelection()][0]")
    assert abs(row - end) < 0.02, row
    for colour in ("displacement", "shear"):
        driver.execute_script(f"const c = document.getElementById('colour'); c.value = '{colour}'; c.dispatchEvent(new Event('change'))")


def main():
    program, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    try:
        driver = browser(1400, 2400, "light")
    except WebDriverException as problem:
        print("skipped: no Chromium with its driver:", str(problem).splitlines()[0])
        return SKIPPED
    (folder / "blocks.json").write_text(json.dumps(SCENE))
    run, ab = folder / "run", folder / "ab"
    words = ["--overwrite", "--quiet"]
    subprocess.run([program, "run", "blocks.json", "--out", "run", *words], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    tolerances = [{"monitor": "a", "quantity": "speed", "largest": 1e-9, "rms": 1e3}]
    compared = subprocess.run([program, "compare", "blocks.json", "--vary", "/contact/model=overlap_area,vertex_edge", "--out", "ab",
                               "--at", "0.00001", "--set", f"/tolerances={json.dumps(tolerances)}", *words],
                              cwd=folder, stdout=subprocess.DEVNULL)
    assert compared.returncode == 6, compared.returncode
    for result, charts in ((run, ["energy", "contacts"]), (ab, ["deviation", "energy", "contact forces"])):
        page = result / "report.html"
        open_page(driver, page)
        check_use(driver, charts)
        check_quiet(driver, page)
        driver.save_screenshot(str(folder / f"{result.name}-light.png"))
    deviations = driver.find_element(By.ID, "deviation-table").text.splitlines()
    assert "at 0.00001 s" in deviations[0], deviations[0]
    assert sum("vertex_edge" in row and not row.endswith("–") for row in deviations) >= 6, deviations
    verdicts = driver.find_element(By.ID, "tolerance-table").text.splitlines()
    assert verdicts[1].endswith("broken") and verdicts[2].endswith("held") and len(verdicts) == 3, verdicts
    assert "talus compare blocks.json --vary /contact/model=overlap_area,vertex_edge" in driver.find_element(By.ID, "provenance").text
    study = folder / "study"
    subprocess.run([program, "study", "blocks.json", "--vary", "/time/dt=4e-4,2e-4,1e-4", "--vary",
                    "/contact/model=overlap_area,vertex_edge", "--out", "study", "--quiet"],
                   cwd=folder, check=True, stdout=subprocess.DEVNULL)
    driver.get((study / "study.html").as_uri())
    check_quiet(driver, study / "study.html")
    assert len(driver.find_elements(By.CSS_SELECTOR, ".drawing svg")) >= 4
    driver.save_screenshot(str(folder / "study-light.png"))
    open_page(driver, ab / "report.html")
    median = driver.execute_script(
        "for (let i = 0; i <= 100; ++i) talus.setTime(talus.shown.end * i / 100);"
        "return talus.drawTimes.slice(-100).sort((p, q) => p - q)[50]")
    driver.quit()
    phone = browser(390, 844, "dark", phone=True)
    open_page(phone, ab / "report.html")
    check_phone(phone, ab / "report.html")
    phone.save_screenshot(str(folder / "ab-dark-phone.png"))
    phone.get((study / "study.html").as_uri())
    check_phone(phone, study / "study.html")
    phone.save_screenshot(str(folder / "study-dark-phone.png"))
    phone.quit()
    print(f"a frame takes {median:.2f} ms to draw (median); pictures in {folder}")
    return 0


sys.exit(main())
